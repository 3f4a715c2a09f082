// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/infill_files.h"

#include "core/file_bytes.h"
#include "core/hash.h"
#include "settings/modifier_list.h"

#include <array>

namespace weft::pipeline {

std::vector<Report::InfillFile> infill_files(const InfillSettings& infill) {
  std::vector<Report::InfillFile> out;
  const auto add = [&](std::string_view key, const std::string& file) {
    if (!file.empty()) out.push_back({std::string(key), file, sha256(FileBytes(file).view())});
  };
  const std::array fields{&infill.infill_density_image, &infill.infill_density_field, &infill.infill_direction_field};
  static_assert(fields.size() == weft::infill_files.size());
  for (std::size_t i = 0; i < fields.size(); ++i) add(weft::infill_files[i], *fields[i]);
  for (const DenseMesh& mesh : parse_modifier_list(infill.infill_modifiers)) add("infill_modifiers", mesh.file);
  return out;
}

}  // namespace weft::pipeline
