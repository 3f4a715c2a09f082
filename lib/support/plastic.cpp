// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/plastic.h"

#include "geometry/offset.h"
#include "geometry/outline_length.h"
#include "support/lengths.h"

#include <algorithm>

namespace weft::support {
namespace {

/// Loops along rims, as far as there is room for them.
double loops_mm2(const Regions& regions, Um line) {
  double mm2 = 0;
  for (const Region& region : regions) mm2 += std::min(area_mm2(region), geometry::outline_mm(region) * to_mm(line));
  return mm2;
}

}  // namespace

double column_mm3(const SupportSettings& settings, Um line, const Region& area, Um height) {
  const double mm2 = area_mm2(area), loop = geometry::outline_mm(area) * to_mm(line),
               share = settings.support_infill_rate / 100;
  const Um half = hollow_column(line, share);
  const Point size = box_of(area.outer).size();
  const bool narrow = std::min(size.x, size.y) <= 2 * half || geometry::offset({area}, {.by = -half}).empty();
  return to_mm(height) * std::min(mm2, narrow ? loop : mm2 * share + loop / 2);
}

double plastic_mm3(const SupportSettings& settings, Um nozzle, const Plan& plan) {
  const Um line = line_width(settings, nozzle);
  double mm3 = 0;
  for (const SupportLayer& layer : plan.layers) {
    for (const Region& column : layer.columns)
      mm3 += layer.first ? area_mm2(column) * to_mm(layer.height) * settings.support_initial_layer_density / 100
                         : column_mm3(settings, line, column, layer.height);
    double mm2 = area_mm2(layer.roof) + area_mm2(layer.bottom);
    mm2 += loops_mm2(layer.branches, line) + loops_mm2(layer.joists.rimmed, line);
    for (const Polyline& joist : layer.joists.lines) mm2 += length_of(joist) / 1000 * to_mm(line);
    mm3 += mm2 * to_mm(layer.height);
  }
  return mm3;
}

}  // namespace weft::support
