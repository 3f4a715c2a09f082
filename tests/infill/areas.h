// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "band.h"
#include "core/polygon.h"
#include "model/bead.h"
#include "picture.h"
#include "rectangle.h"

#include <algorithm>
#include <cmath>
#include <numbers>

/// What the tests of infill share: simple areas, and an independent look at what beads cover.
namespace weft::test {

inline Region with_hole(Region region, Um x0, Um y0, Um x1, Um y1) {
  region.holes.push_back({{x0, y0}, {x0, y1}, {x1, y1}, {x1, y0}});
  return region;
}

/// How many beads' bands lie over a place.
inline std::ptrdiff_t cover(const Beads& beads, double x, double y) {
  return std::count_if(beads.begin(), beads.end(), [&](const Bead& bead) { return covers(bead, x, y); });
}

inline bool holds(const Regions& regions, Point p) {
  for (const Region& region : regions) {
    if (side_of(region.outer, p) == Side::outside) continue;
    bool in_hole = false;
    for (const Ring& hole : region.holes) in_hole |= side_of(hole, p) == Side::inside;
    if (!in_hole) return true;
  }
  return false;
}

/// Volume of beads of unit height, mm² : what they cover if they do not overlap.
inline double covered_mm2(const Beads& beads) {
  tests::show_beads(beads);
  double sum = 0;
  for (const Bead& bead : beads) sum += volume_mm3(bead, 1000);
  return sum;
}

inline double degrees(double d) {
  return d * std::numbers::pi / 180;
}

/// A star-shaped polygon of seeded spikes: the same every time.
inline Region star(std::uint32_t seed, Um radius, int points) {
  Region region;
  std::uint32_t state = seed * 2654435761U + 1;
  for (int i = 0; i < points; ++i) {
    state = state * 1664525U + 1013904223U;
    const double r = radius * (0.4 + 0.6 * (state >> 8) / double(1U << 24)), a = 2 * std::numbers::pi * i / points;
    region.outer.push_back({rounded(r * std::cos(a)), rounded(r * std::sin(a))});
  }
  return region;
}

}  // namespace weft::test
