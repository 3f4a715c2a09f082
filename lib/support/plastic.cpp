// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/plastic.h"

#include "geometry/offset.h"
#include "geometry/outline_length.h"
#include "model/flow.h"
#include "support/lengths.h"
#include "support/stack.h"

#include <algorithm>

namespace weft::support {
namespace {

/// Loops along rims, as far as there is room for them.
double loops_mm2(const Regions& regions, Um band) {
  double mm2 = 0;
  for (const Region& region : regions) mm2 += std::min(area_mm2(region), geometry::outline_mm(region) * to_mm(band));
  return mm2;
}

}  // namespace

Um usual_band(const SupportSettings& settings, Um nozzle) {
  return flow::band(line_width(settings, nozzle), most_height(settings, nozzle));
}

double column_mm3(const SupportSettings& settings, Um nozzle, const Region& area, Um height) {
  const double mm2 = area_mm2(area), share = settings.support_infill_rate / 100;
  const Um half = hollow_column(line_width(settings, nozzle), share);
  const Point size = box_of(area.outer).size();
  const bool narrow = std::min(size.x, size.y) <= 2 * half || geometry::offset({area}, {.by = -half}).empty();
  if (!narrow) return to_mm(height) * mm2 * share;
  return to_mm(height) * std::min(mm2, geometry::outline_mm(area) * to_mm(usual_band(settings, nozzle)));
}

double plastic_mm3(const SupportSettings& settings, Um nozzle, const Plan& plan) {
  const Um band = usual_band(settings, nozzle);
  double mm3 = 0;
  for (const SupportLayer& layer : plan.layers) {
    for (const Region& column : layer.columns)
      mm3 += layer.first ? area_mm2(column) * to_mm(layer.height) * settings.support_initial_layer_density / 100
                         : column_mm3(settings, nozzle, column, layer.height);
    double mm2 =
        area_mm2(layer.roof) + area_mm2(layer.under_roof) * under_roof_share(settings) + area_mm2(layer.bottom);
    mm2 += loops_mm2(layer.branches, band) + loops_mm2(layer.joists.rimmed, band);
    for (const auto* lines : {&layer.joists.lines, &layer.joists.after})
      for (const Polyline& joist : *lines) mm2 += length_of(joist) / 1000 * to_mm(band);
    mm3 += mm2 * to_mm(layer.height);
  }
  return mm3;
}

}  // namespace weft::support
