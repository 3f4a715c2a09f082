// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/statistics.h"

#include <algorithm>

namespace weft {

Statistics::Tool& Statistics::tool(ToolId id) {
  if (tools.size() <= id) tools.resize(id + std::size_t{1});
  return tools[id];
}

void Statistics::append(const Statistics& later) {
  for (std::size_t i = 0; i < features.size(); ++i) {
    features[i].mm += later.features[i].mm;
    features[i].mm3 += later.features[i].mm3;
    features[i].s += later.features[i].s;
  }
  walls.beads += later.walls.beads;
  walls.variable_width_mm += later.walls.variable_width_mm;
  walls.flow_compensated_mm += later.walls.flow_compensated_mm;
  walls.min_flow_ratio = std::min(walls.min_flow_ratio, later.walls.min_flow_ratio);
  for (std::size_t i = 0; i < walls.over_air_mm.size(); ++i) walls.over_air_mm[i] += later.walls.over_air_mm[i];
  walls.whole_over_air_mm += later.walls.whole_over_air_mm;
  walls.min_width = std::min(walls.min_width, later.walls.min_width);
  arcs.count += later.arcs.count;
  arcs.pieces += later.arcs.pieces;
  arcs.worst_um = std::max(arcs.worst_um, later.arcs.worst_um);
  travel.mm += later.travel.mm;
  travel.s += later.travel.s;
  travel.moves += later.travel.moves;
  travel.retractions += later.travel.retractions;
  travel.wall_crossings += later.travel.wall_crossings;
  travel.retraction_s += later.travel.retraction_s;
  for (std::size_t i = 0; i < later.tools.size(); ++i) {
    auto& sum = tool(static_cast<ToolId>(i));
    sum.filament_mm += later.tools[i].filament_mm;
    sum.filament_mm3 += later.tools[i].filament_mm3;
    sum.filament_g += later.tools[i].filament_g;
    sum.s += later.tools[i].s;
    sum.tower_mm3 += later.tools[i].tower_mm3;
    sum.changes += later.tools[i].changes;
  }
  filament_mm += later.filament_mm;
  filament_mm3 += later.filament_mm3;
  filament_g += later.filament_g;
  layer_s.insert(layer_s.end(), later.layer_s.begin(), later.layer_s.end());
  silent_layer_s.insert(silent_layer_s.end(), later.silent_layer_s.begin(), later.silent_layer_s.end());
  print_time_s += later.print_time_s;
}

}  // namespace weft
