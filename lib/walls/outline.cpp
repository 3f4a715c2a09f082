// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/outline.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "model/flow.h"

#include <algorithm>
#include <numbers>

namespace weft::walls {
namespace {

std::size_t corners_of(const Region& region) {
  std::size_t sum = region.outer.size();
  for (const Ring& hole : region.holes) sum += hole.size();
  return sum;
}

/// Whether a ring has a convex corner so sharp that its tip draws back far.
bool has_needle(const Ring& ring) {
  constexpr double sine = 0.09;  // of 5°
  for (std::size_t i = 0, n = ring.size(); i < n; ++i) {
    const Point a = ring[i], u = ring[(i + n - 1) % n] - a, v = ring[(i + 1) % n] - a;
    const double ux = u.x, uy = u.y, vx = v.x, vy = v.y;
    const double cross = ux * vy - uy * vx, dot = ux * vx + uy * vy;
    if (dot > 0 && cross < 0 && -cross < sine * dot) return true;
  }
  return false;
}

bool has_needle(const Region& region) {
  if (has_needle(region.outer)) return true;
  for (const Ring& hole : region.holes)
    if (has_needle(hole)) return true;
  return false;
}

/// The thin stretches of `part` of which nothing is left in `moved`, its outlines drawn in by `by`.
Regions lost(const Region& part, const Regions& moved, Um by) {
  constexpr Um lattice = 1;     // outlines moved there and back lie so near
  constexpr double miter = 20;  // sharp corners come back whole
  return geometry::subtract({part}, geometry::offset(moved, {.by = by + lattice, .miter_limit = miter}));
}

/// Each hole by the share of hole_xy_offset that its size leaves: all of it for the smallest, none from
/// hole_xy_offset_max_diameter on, even by the area between.
Regions widened_by_size(const WallSettings& settings, const Regions& holes) {
  const double most = to_mm(*settings.hole_xy_offset_max_diameter), most_mm2 = std::numbers::pi / 4 * most * most;
  Regions out;
  for (const Region& hole : holes) {
    const double share = std::max(0.0, 1 - area_mm2(hole) / most_mm2);
    const Um by = rounded(share * settings.hole_xy_offset) - settings.xy_offset;
    if (by == 0) {
      out.push_back(hole);
      continue;
    }
    const auto widened = geometry::offset({hole}, {.by = by});
    out.insert(out.end(), widened.begin(), widened.end());
  }
  return out;
}

}  // namespace

Regions offset_outlines(const WallSettings& settings, const Regions& regions) {
  const Um by = settings.xy_offset;
  const Um holes_by = settings.hole_xy_offset - by;
  if (by == 0 && holes_by == 0) return regions;
  Regions solid, holes;
  for (const Region& region : regions) {
    solid.push_back({region.outer, {}});
    for (const Ring& hole : region.holes) holes.push_back({Ring(hole.rbegin(), hole.rend()), {}});
  }
  if (by != 0) solid = geometry::offset(solid, {.by = by});
  if (settings.hole_xy_offset_max_diameter && settings.hole_xy_offset != 0)
    holes = widened_by_size(settings, holes);
  else if (holes_by != 0)
    holes = geometry::offset(holes, {.by = holes_by});
  return geometry::subtract(solid, holes);
}

Regions drawn_in(const WallSettings& settings, const Regions& regions, Um by, Um least) {
  WallSettings others = settings;
  others.xy_offset += by;
  const Regions drawn = offset_outlines(settings, regions), whole = offset_outlines(others, regions);
  const Um radius = least / 2 + by;
  const double dot_mm2 = to_mm(least) * to_mm(least) / 4;  // less is the tip of a corner
  Regions thin = geometry::subtract(whole, geometry::opening(whole, radius, geometry::Corner::miter));
  std::erase_if(thin, [&](const Region& region) { return area_mm2(region) < dot_mm2; });
  if (thin.empty()) return drawn;
  // What is drawn in beside it begins `by` further in: there they meet.
  const Regions kept = geometry::intersect(whole, geometry::offset(thin, {.by = 2 * by}));
  return geometry::unite(drawn, kept);
}

Within within(const Region& part, Um bulge) {
  if (bulge == 0) return {{part}, {}};
  Within out{geometry::offset({part}, {.by = -bulge}), {}};
  std::size_t corners = 0;
  for (const Region& region : out.regions) corners += corners_of(region);
  // Something thin that goes takes its corners along.
  if (corners < corners_of(part) || has_needle(part)) out.thin = lost(part, out.regions, bulge);
  return out;
}

void widen_thin(Um bulge, Um height, Beads& beads) {
  const double round = height * (1 - flow::rounding);  // the band of a strand as wide as high
  for (Bead& bead : beads) {
    if (bead.inset > 0 || bead.closed) continue;
    for (Junction& j : bead.path) {
      const double band = j.width * static_cast<double>(j.flow);
      if (band >= round) continue;
      const double wanted = std::min(band + 2 * bulge, round);
      if (wanted > j.width)
        j.width = rounded(wanted), j.flow = 1.F;
      else
        j.flow = static_cast<float>(wanted / j.width);
    }
  }
}

}  // namespace weft::walls
