// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/swap_filament.h"

#include "settings/tools.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::pipeline {
namespace {

/// Each number of filament_ramming_parameters holds for so long.
constexpr double ramming_step_s = 0.25;
/// Drawn out at once, before the melt can follow.
constexpr double at_once_mm = 15;
/// From the tube to where filament waits.
constexpr double parking_mm_s = 2000.0 / 60;

Feed feed(double mm, double mm_s) {
  return {mm, std::abs(mm) / mm_s, false, {}, 0};
}

void add(std::vector<Step>& out, double mm, double mm_s) {
  if (mm != 0) out.emplace_back(feed(mm, mm_s));
}

/// Along the line, as far as each flow comes in its time; at its end back again.
void ram_along(const Settings& tool, const Bead& line, Um z, Um height, std::vector<Step>& out) {
  const auto flows = ramming_flows(tool.tools.filament_ramming_parameters);
  if (flows.empty() || line.path.size() < 2) return;
  out.emplace_back(std::in_place_type<Retract>);
  const Point begin = line.path.front().at;
  out.emplace_back(Travel{.path = {{begin.x, begin.y, z}}});
  out.emplace_back(std::in_place_type<Prime>);
  const double d = to_mm(tool.material.filament_diameter), area_mm2 = std::numbers::pi / 4 * d * d;
  const Um width = line.path.front().width;
  const double bead_mm2 = to_mm(width) * to_mm(height);
  std::size_t next = 1;
  bool back = false;
  Point at = begin;
  for (const double mm3_s : flows) {
    double left_um = 1000 * mm3_s * ramming_step_s / bead_mm2;
    while (left_um >= 1) {
      const Point to = line.path[next].at;
      const double um = distance(at, to);
      const double share = um > left_um ? left_um / um : 1;
      const Point stop{at.x + rounded((to.x - at.x) * share), at.y + rounded((to.y - at.y) * share)};
      const double mm3 = std::min(um, left_um) / 1000 * bead_mm2;
      if (stop != at) out.emplace_back(Feed{mm3 / area_mm2, mm3 / mm3_s, true, stop, width});
      at = stop;
      if (share < 1) break;
      left_um -= um;
      if (next + 1 == line.path.size()) back = true;
      if (next == 0) back = false;
      next = back ? next - 1 : next + 1;
    }
  }
}

}  // namespace

std::vector<Step> unload(const Settings& tool, const std::optional<Bead>& ram, Um z, Um height) {
  const auto& t = tool.tools;
  std::vector<Step> out;
  if (t.parking_pos_retraction == 0) return out;
  if (ram) ram_along(tool, *ram, z, height, out);
  const double tube = to_mm(t.cooling_tube_length), middle = to_mm(t.cooling_tube_retraction);
  const double rest = std::max(0.0, middle + tube / 2 - at_once_mm);
  add(out, -at_once_mm, t.filament_unloading_speed_start);
  add(out, -0.7 * rest, t.filament_unloading_speed);
  add(out, -0.2 * rest, 0.5 * t.filament_unloading_speed);
  add(out, -0.1 * rest, 0.3 * t.filament_unloading_speed);
  const int moves = t.filament_cooling_moves;
  for (int i = 0; i < 2 * moves; ++i) {
    const double share = moves > 0 ? i / (2.0 * moves - 1) : 0;
    const double speed =
        t.filament_cooling_initial_speed + share * (t.filament_cooling_final_speed - t.filament_cooling_initial_speed);
    add(out, i % 2 == 0 ? tube : -tube, speed);
  }
  add(out, at_once_mm + rest - to_mm(t.parking_pos_retraction), parking_mm_s);
  if (t.filament_toolchange_delay > 0) out.emplace_back(Feed{0, t.filament_toolchange_delay, false, {}, 0});
  return out;
}

std::vector<Step> load(const Settings& tool) {
  const auto& t = tool.tools;
  std::vector<Step> out;
  if (t.parking_pos_retraction == 0) return out;
  const double mm = to_mm(t.parking_pos_retraction + t.extra_loading_move);
  add(out, 0.2 * mm, t.filament_loading_speed_start);
  add(out, 0.7 * mm, t.filament_loading_speed);
  add(out, 0.1 * mm, 0.1 * t.filament_loading_speed);
  return out;
}

}  // namespace weft::pipeline
