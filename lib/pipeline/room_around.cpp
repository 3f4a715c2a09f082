// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/room_around.h"

#include "model/flow.h"
#include "pipeline/add_raft.h"
#include "settings/head_profile.h"
#include "settings/tools.h"
#include "tools/purge.h"
#include "tools/tower.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace weft::pipeline {

namespace {

Um width_of_skirt(const AdhesionSettings& around, const Settings& settings) {
  if (around.skirt_line_count == 0) return 0;
  const Um nozzle = settings.machine.nozzle_diameter;
  const Um height = settings.layers.initial_layer_height.value_or(settings.layers.layer_height);
  const Um line = length_or(around.skirt_brim_line_width, nozzle, flow::automatic_width(nozzle, height));
  return around.skirt_gap + around.skirt_line_count * line;
}

}  // namespace

Um wider_of(const Settings& settings) {
  const WallSettings& walls = settings.walls;
  return std::max({0, walls.xy_offset, walls.xy_offset + walls.xy_offset_layer_0});
}

Um brim_of(const Settings& settings) {
  return adhesion_of(settings.adhesion).brim_width;
}

Um skirt_of(const Settings& settings) {
  const auto around = adhesion_of(settings.adhesion);
  if (around.skirt_line_count == 0 || around.adhesion_outside == AdhesionOutside::clip) return 0;
  const bool raft = around.adhesion_type == AdhesionType::raft;  // which the skirt lies around
  return (raft ? settings.raft.raft_margin : 0) + width_of_skirt(around, settings);
}

Um beside_of(const Settings& settings) {
  const auto around = adhesion_of(settings.adhesion);
  return (around.brim_width > 0 ? around.brim_gap + around.brim_width : 0) + width_of_skirt(around, settings);
}

Um apart_of(const Settings& settings) {
  if (settings.plate.print_sequence != PrintSequence::one_at_a_time) return 0;
  Um head = 0;
  for (const auto& slab : parse_head_profile(settings.plate.machine_head_profile))
    for (const Point p : slab.outline) head = std::max({head, std::abs(p.x), std::abs(p.y)});
  return head + beside_of(settings);
}

std::optional<Ring> tower_of(const Settings& settings, const Ring& surface) {
  const std::size_t count = tool_count(settings);
  if (count < 2) return std::nullopt;
  const auto tools = settings_of_tools(settings);
  if (!settings.tools.prime_tower_enable.value_or(shares_nozzle(tools))) return std::nullopt;
  double most = 0;
  for (const auto& row : tools::purge_volumes(tools))
    for (const double mm3 : row) most = std::max(most, mm3);
  Um nozzle = max_coord;
  for (const auto& tool : tools) nozzle = std::min(nozzle, tool.machine.nozzle_diameter);
  // At its largest a layer is printed with all tools, of which the first was loaded by the one below.
  tools::TowerLayer largest{settings.layers.layer_height, settings.layers.layer_height, {}};
  for (std::size_t i = 0; i + 1 < count; ++i) largest.strips.push_back({i, most, false});
  const auto size = tools::tower_size(settings.tools, {&largest, 1}, nozzle);
  const auto& t = settings.tools;
  std::optional<Point> corner;
  if (t.prime_tower_position_x && t.prime_tower_position_y)
    corner = Point{*t.prime_tower_position_x, *t.prime_tower_position_y};
  const Point back = box_of(surface).max;
  if (!corner)
    corner =
        tools::place_for_tower(t, size, surface, settings.machine.bed_exclude_areas, std::vector{Box{back, back}}, 0);
  if (!corner) return std::nullopt;
  const Box box = box_of(tools::tower_outline(t, size, *corner)).grown(beside_tower);
  return Ring{box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
}

}  // namespace weft::pipeline
