// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/groups/machine.h"

#include "core/tolerances.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft {
namespace {

Ring counter_clockwise(Ring ring) {
  if (double_area(ring) < 0) std::reverse(ring.begin(), ring.end());
  return ring;
}

Ring box_ring(const Box& box) {
  return {box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
}

/// Chords of n corners stand off the circle by radius · (1 − cos(π/n)).
Ring circle(Point centre, Um radius) {
  const double share = std::min(1.0, double{tolerances::arc} / radius);
  const auto quarter = static_cast<int>(std::ceil(std::numbers::pi / std::acos(1.0 - share) / 4.0));
  Ring ring;
  for (int i = 0; i < 4 * quarter; ++i) {
    const double angle_rad = std::numbers::pi * i / (2.0 * quarter);
    ring.push_back(centre + Point{rounded(radius * std::cos(angle_rad)), rounded(radius * std::sin(angle_rad))});
  }
  return ring;
}

bool on_segment(Point a, Point b, Point p) {
  return orient(a, b, p) == 0 && p.x >= std::min(a.x, b.x) && p.x <= std::max(a.x, b.x) && p.y >= std::min(a.y, b.y) &&
         p.y <= std::max(a.y, b.y);
}

bool touch(Point a, Point b, Point c, Point d) {
  const auto left = [](Point p, Point q, Point r) { return orient(p, q, r) > 0; };
  const bool apart = on_segment(a, b, c) || on_segment(a, b, d) || on_segment(c, d, a) || on_segment(c, d, b);
  return apart || (orient(a, b, c) != 0 && orient(a, b, d) != 0 && left(a, b, c) != left(a, b, d) &&
                   left(c, d, a) != left(c, d, b));
}

}  // namespace

Ring print_surface(const MachineSettings& machine) {
  if (machine.bed_shape == BedShape::polygon) return counter_clockwise(machine.bed_polygon);
  const Point size{machine.machine_width, machine.machine_depth};
  const Point least = machine.machine_center_is_zero ? Point{-size.x / 2, -size.y / 2} : Point{};
  if (machine.bed_shape == BedShape::circle) return circle(least + Point{size.x / 2, size.y / 2}, size.x / 2);
  return box_ring({least, least + size});
}

Ring reach_area(const MachineSettings& machine) {
  if (machine.machine_reach.empty()) return print_surface(machine);
  if (machine.machine_reach.size() == 2) return box_ring(box_of(machine.machine_reach));
  return counter_clockwise(machine.machine_reach);
}

std::optional<MachineSettings> in_silent_mode(const MachineSettings& machine) {
  const auto& limits = machine.machine_silent_limits;
  if (limits.size() != silent_limits) return std::nullopt;
  MachineSettings out = machine;
  out.machine_max_speed_x = limits[0], out.machine_max_speed_y = limits[1];
  out.machine_max_speed_z = limits[2], out.machine_max_speed_e = limits[3];
  out.machine_max_acceleration_x = limits[4], out.machine_max_acceleration_y = limits[5];
  out.machine_max_acceleration_z = limits[6], out.machine_max_acceleration_e = limits[7];
  out.machine_max_jerk = limits[8], out.machine_max_jerk_z = limits[9], out.machine_max_jerk_e = limits[10];
  return out;
}

bool is_simple(const Ring& ring) {
  const std::size_t n = ring.size();
  const auto at = [&](std::size_t i) { return ring[i % n]; };
  for (std::size_t i = 0; i < n; ++i) {
    if (at(i) == at(i + 1) ||
        (n > 2 && (on_segment(at(i), at(i + 1), at(i + 2)) || on_segment(at(i + 1), at(i + 2), at(i)))))
      return false;
    for (std::size_t j = i + 2; j < n; ++j)
      if (!(i == 0 && j == n - 1) && touch(at(i), at(i + 1), at(j), at(j + 1))) return false;
  }
  return true;
}

}  // namespace weft
