#pragma once
#include "core/polygon.h"
#include "model/bead.h"

#include <cmath>
#include <numbers>

/// What the tests of infill share: simple areas, and an independent look at what beads cover.
namespace weft::test {

inline Region rectangle(Um x0, Um y0, Um x1, Um y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

inline Region with_hole(Region region, Um x0, Um y0, Um x1, Um y1) {
  region.holes.push_back({{x0, y0}, {x0, y1}, {x1, y1}, {x1, y0}});
  return region;
}

/// How many bands of beads lie over p. Bands end square; inner joints are round.
inline int cover(const Beads& beads, double x, double y) {
  int n = 0;
  for (const Bead& bead : beads) {
    const std::size_t segments = bead.path.size() - (bead.closed ? 0 : 1);
    bool hit = false;
    for (std::size_t i = 0; i < segments && !hit; ++i) {
      const Junction &a = bead.path[i], &b = bead.path[(i + 1) % bead.path.size()];
      const double dx = b.at.x - a.at.x, dy = b.at.y - a.at.y, l = std::hypot(dx, dy);
      const double px = x - a.at.x, py = y - a.at.y;
      const double along = (px * dx + py * dy) / l, off = std::abs(px * dy - py * dx) / l;
      const double half = (a.width + (b.width - a.width) * along / l) / 2;
      hit = along >= 0 && along <= l && off <= half;
      if (!hit && (i > 0 || bead.closed)) hit = std::hypot(px, py) <= a.width / 2.0;
    }
    n += hit;
  }
  return n;
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
