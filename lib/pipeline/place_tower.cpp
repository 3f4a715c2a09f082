// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/place_tower.h"

#include "core/error.h"
#include "pipeline/change_tool.h"
#include "pipeline/room_around.h"
#include "settings/tools.h"
#include "tools/purge.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

/// A change to each tool but the one that is loaded, at its dearest, in the thinnest of layers.
tools::TowerLayer busiest_section(const std::vector<Settings>& tools, const std::vector<ToolId>& used, Um top) {
  const auto volumes = tools::purge_volumes(tools);
  std::vector<tools::TowerLayer::Strip> to_each;
  Um height = max_coord;
  for (const ToolId to : used) {
    auto& dearest = to_each.emplace_back();
    for (const ToolId from : used)
      if (from != to)
        dearest.mm3 = std::max(dearest.mm3, volumes[from][to] + rammed_mm3(tools, {0, to, true, from, 0}));
    height = std::min(height, tools[to].layers.layer_height);
  }
  to_each.erase(
      std::min_element(to_each.begin(), to_each.end(), [](const auto& a, const auto& b) { return a.mm3 < b.mm3; }));
  return {top, height, std::move(to_each)};
}

/// Over which side of the bed a tower reaches, by how much, and where it would stand along it.
struct Overrun {
  std::string_view key, side, bound;
  Um by, within;
};
/// The sides that it reaches over, the farthest first. @param around room that it needs beside itself, for a skirt
std::vector<Overrun> overruns_of(const Box& tower, const Box& bed, Point corner, Um around) {
  const Um right = tower.max.x - bed.max.x, left = bed.min.x - tower.min.x;
  const Um behind = tower.max.y - bed.max.y, before = bed.min.y - tower.min.y;
  std::vector sides{Overrun{"prime_tower_position_x", "+x", "most", right, corner.x - right - around},
                    Overrun{"prime_tower_position_x", "-x", "least", left, corner.x + left + around},
                    Overrun{"prime_tower_position_y", "+y", "most", behind, corner.y - behind - around},
                    Overrun{"prime_tower_position_y", "-y", "least", before, corner.y + before + around}};
  std::erase_if(sides, [](const Overrun& side) { return side.by <= 0; });
  std::stable_sort(sides.begin(), sides.end(), [](const auto& a, const auto& b) { return a.by > b.by; });
  return sides;
}

/// "auto, or at most 188; prime_tower_position_y at most 165"
std::string where_instead(const std::vector<Overrun>& over) {
  auto out = fmt::format("auto, or at {} {:g}", over[0].bound, to_mm(over[0].within));
  for (std::size_t i = 1; i < over.size(); ++i)
    out += fmt::format("; {} at {} {:g}", over[i].key, over[i].bound, to_mm(over[i].within));
  return out;
}

/// @throws Error{audit} where a tower of that size, standing where it is told to, leaves the print surface
void refuse_outside(const Settings& plate, const tools::TowerSize& size, Point corner) {
  const Ring surface = print_surface(plate.machine);
  const auto outline = tools::tower_outline(plate.tools, size, corner);
  const auto outside = tools::outside_of(outline, surface);
  if (outside.by <= plate.audit.audit_tolerance) return;
  const Box tower = box_of(outline), bed = box_of(surface);
  const auto over = overruns_of(tower, bed, corner, skirt_of(plate));
  const bool fits = tower.size().x <= bed.size().x && tower.size().y <= bed.size().y;
  throw Error{
      Error::Kind::audit,
      fmt::format("{}: the tower with its brim, {:.1f} × {:.1f} mm at ({:g}, {:g}), leaves the print surface by "
                  "{:.1f} mm at {}",
                  over.empty() ? "prime_tower_position_x" : over[0].key, to_mm(tower.size().x), to_mm(tower.size().y),
                  to_mm(corner.x), to_mm(corner.y), to_mm(outside.by), over.empty() ? "the edge" : over[0].side),
      {},
      !over.empty() && fits ? where_instead(over) : std::string("auto puts it where there is room")};
}

std::optional<Point> told_corner(const ToolSettings& t) {
  if (!t.prime_tower_position_x || !t.prime_tower_position_y) return std::nullopt;
  return Point{*t.prime_tower_position_x, *t.prime_tower_position_y};
}

}  // namespace

bool wants_tower(const Settings& plate, const ToolScopes& tools) {
  return plate.tools.prime_tower_enable.value_or(shares_nozzle(tools.tools()));
}

Um least_nozzle(const std::vector<Settings>& tools) {
  return std::min_element(
             tools.begin(), tools.end(),
             [](const auto& a, const auto& b) { return a.machine.nozzle_diameter < b.machine.nozzle_diameter; })
      ->machine.nozzle_diameter;
}

void add_strips(const std::vector<Settings>& tools, const ToolPass& pass, std::size_t p, tools::TowerLayer& section) {
  if (const double mm3 = rammed_mm3(tools, pass); mm3 > 0) section.strips.push_back({p, mm3, true});
  if (pass.purge_mm3 > 0) section.strips.push_back({p, pass.purge_mm3, false});
}

std::vector<Box> standing_on(const Settings& plate, std::span<const travel::LayerInput> layers) {
  std::vector<std::pair<std::pair<ObjectId, std::uint32_t>, Box>> by_object;
  for (const auto& layer : layers)
    for (const auto& object : layer.objects) {
      const auto key = std::pair(object.object, object.stack);
      auto at = std::find_if(by_object.begin(), by_object.end(), [&](const auto& b) { return b.first == key; });
      if (at == by_object.end()) at = by_object.insert(at, {key, Box{}});
      for (const auto& region : object.outline) at->second.add(box_of(region.outer));
    }
  const bool brim = plate.adhesion.adhesion_type == AdhesionType::brim;
  std::vector<Box> out;
  for (const auto& [key, box] : by_object)
    if (!box.empty()) out.push_back(box.grown(brim ? plate.adhesion.brim_width : 0));
  for (const auto& layer : layers) {  // a raft
    Box raft;
    for (const auto& bead : layer.adhesion) raft.add(box_of(bead));
    if (!raft.empty()) out.push_back(raft);
  }
  return out;
}

void refuse_tower_outside(const Settings& plate, const ToolScopes& tools, Um top) {
  const auto told = told_corner(plate.tools);
  const auto used = tools.used();
  if (!told || !wants_tower(plate, tools) || used.size() < 2) return;
  const Um nozzle = least_nozzle(tools.tools());
  const Ring surface = print_surface(plate.machine);
  const auto least = tools::tower_size(plate.tools, {}, nozzle);
  if (tools::outside_of(tools::tower_outline(plate.tools, least, *told), surface).by <= plate.audit.audit_tolerance)
    return;
  refuse_outside(plate, tools::tower_size(plate.tools, std::array{busiest_section(tools.tools(), used, top)}, nozzle),
                 *told);
}

void place_tower(const Settings& plate, std::vector<Box> standing, Passes& passes) {
  const auto& t = plate.tools;
  const auto& size = passes.size;
  if (const auto told = told_corner(t)) return refuse_outside(plate, size, passes.corner = *told);
  const Ring surface = print_surface(plate.machine);
  for (const auto& region : passes.shield) standing.push_back(box_of(region.outer));
  const auto place = tools::place_for_tower(t, size, surface, plate.machine.bed_exclude_areas, standing, beside_tower);
  if (!place)
    throw Error{Error::Kind::audit,
                fmt::format("prime_tower_enable: no room on the bed for the tower, {:.1f} × {:.1f} mm",
                            to_mm(size.width), to_mm(size.depth)),
                {},
                "move the models, give purge_volumes that are less, or prime_tower_enable = false"};
  passes.corner = *place;
}

}  // namespace weft::pipeline
