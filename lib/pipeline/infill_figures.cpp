// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/infill_figures.h"

#include "infill/figures.h"
#include "pipeline/report.h"
#include "tasks/tasks.h"

#include <algorithm>
#include <vector>

namespace weft::pipeline {

void tell_infill(const Settings& settings, const PrintedLayers& layers, Report& report) {
  std::vector<infill::LookedAtLayer> seen;
  seen.reserve(layers.size());
  for (const PrintedLayer& layer : layers) seen.push_back({layer.height, &layer.outline, &layer.sparse, &layer.beads});
  const infill::Figures figures = infill::figures_of(settings.infill, seen, tasks::for_each_index);
  if (figures.mm3 <= report.infill.mm3) return;
  const auto& f = figures;
  Report::Infill& to = report.infill;
  constexpr auto choices = choices_of(InfillPattern{});
  to.pattern = choices[static_cast<std::size_t>(settings.infill.infill_pattern)].name;
  to.mm3 = f.mm3, to.density_percent = 100 * f.density(), to.density_spread_percent = 100 * f.density_spread;
  to.length_spread_percent = 100 * f.length_spread;
  to.fabric = f.fabric;
  to.over_air_percent = f.looked_mm > 0 ? 100 * f.over_air_mm / f.looked_mm : 0;
  to.locality = f.locality, to.box_dimension = f.box_dimension;
  to.stiffness_plane_percent = 100 * f.bounds.stiffness_plane, to.stiffness_z_percent = 100 * f.bounds.stiffness_z;
  to.conductivity_plane_percent = 100 * f.bounds.conductivity_plane,
  to.conductivity_z_percent = 100 * f.bounds.conductivity_z;
}

}  // namespace weft::pipeline
