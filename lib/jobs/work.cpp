// SPDX-License-Identifier: GPL-3.0-or-later
#include "jobs/work.h"

#include "pipeline/model_parts.h"

#include <algorithm>
#include <filesystem>

namespace weft::jobs {

double estimated_work(const Job& job) {
  // What every job takes beside its mesh, as bytes of one; and a 3MF is packed.
  constexpr double any_job = 1 << 17, packed = 5;
  double bytes = any_job;
  for (const auto& model : pipeline::files_of(job.models)) {
    std::error_code unknown;
    const auto size = std::filesystem::file_size(model, unknown);
    if (!unknown) bytes += static_cast<double>(size) * (model.ends_with(".3mf") ? packed : 1);
  }
  const double layers_per_mm = 1 / std::max(to_mm(job.settings.layers.layer_height), 0.01);
  return bytes * job.placement.copies * layers_per_mm;
}

}  // namespace weft::jobs
