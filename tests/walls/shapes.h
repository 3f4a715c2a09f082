// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "picture.h"
#include "rectangle.h"
#include "walls/walls.h"

#include <cmath>
#include <numbers>
#include <random>

namespace weft::test {

inline Ring circle(Point centre, Um radius, int corners, bool hole = false) {
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double a = 2 * std::numbers::pi * (hole ? -i : i) / corners;
    ring.push_back({centre.x + rounded(radius * std::cos(a)), centre.y + rounded(radius * std::sin(a))});
  }
  return ring;
}

/// A star-shaped polygon with random corners: convex and reflex, thick and thin.
inline Ring random_ring(std::mt19937& random) {
  const int corners = 3 + static_cast<int>(random() % 14);
  const double size = 400 + static_cast<double>(random() % 6000);
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double share = 0.25 + 0.75 * static_cast<double>(random() % 1000) / 1000;
    const double a = 2 * std::numbers::pi * (i + 0.6 * static_cast<double>(random() % 1000) / 1000) / corners;
    ring.push_back({rounded(size * share * std::cos(a)), rounded(size * share * std::sin(a))});
  }
  return ring;
}

inline SlicedLayer layer_of(Regions regions) {
  return {0.2_mm, 0.2_mm, std::move(regions)};
}

/// By name: clang 14 takes no consteval literal as a default argument.
constexpr Um usual_nozzle = 0.4_mm;

/// Bands that end on the outline: what is laid can be held against the part's area.
inline WallSettings by_volume() {
  WallSettings settings;
  settings.wall_outline = WallOutline::volume;
  return settings;
}

/// Walls of one layer, the second of an object.
inline WallLayer built(const Regions& regions, const WallSettings& settings = by_volume(), Um nozzle = usual_nozzle) {
  const SlicedLayer layer = layer_of(regions);
  tests::look_at(regions);
  WallLayer walls = walls::build(settings, {.layer = layer, .index = 1, .nozzle_diameter = nozzle});
  tests::show_beads(walls.beads);
  return walls;
}

/// Area of the bands of all beads, mm².
inline double bead_area_mm2(const WallLayer& walls) {
  double sum = 0;
  for (const Bead& bead : walls.beads) sum += volume_mm3(bead, 1_mm);
  return sum;
}

}  // namespace weft::test
