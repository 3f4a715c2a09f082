// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/near_edge.h"

#include "geometry/spatial_index.h"
#include "support/lengths.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace weft::support {
namespace {

/// Whether every point of an edge is near: between two points it is no further away than they are and half way between
/// them.
class NearAll {
 public:
  explicit NearAll(const Regions& edge) : edge_(edge) {}

  bool of(const Ring& ring, double limit_um) const {
    auto from = distance_to(ring.back(), limit_um);
    Point a = ring.back();
    for (const Point b : ring) {
      const auto to = distance_to(b, limit_um);
      if (!from || !to || !between(a, *from, b, *to, limit_um)) return false;
      a = b, from = to;
    }
    return true;
  }

 private:
  std::optional<double> distance_to(Point p, double limit_um) const {
    const auto found = edge_.nearest(p, limit_um);
    return found ? std::optional(found->distance_um) : std::nullopt;
  }
  bool between(Point a, double from, Point b, double to, double limit_um) const {
    constexpr double shortest_um = 20;
    const double length = distance(a, b);
    if (from + to + length <= 2 * limit_um) return true;
    if (length < shortest_um) return false;
    const Point middle = lerp(a, b, 0.5);
    const auto there = distance_to(middle, limit_um);
    return there && between(a, from, middle, *there, limit_um) && between(middle, *there, b, to, limit_um);
  }

  geometry::SegmentIndex edge_;
};

}  // namespace

bool any_may_be_further(const Regions& regions, const Regions& than, Um by) {
  constexpr double rounded_um = 3;
  // No place of a region is further from its outline than the radius of a circle as large.
  const auto limit_um = [by](const Region& region) {
    return by - coarse_arc - rounded_um - 1000 * std::sqrt(std::max(area_mm2(region), 0.0) / std::numbers::pi);
  };
  if (std::any_of(regions.begin(), regions.end(), [&](const Region& region) { return limit_um(region) <= 0; }))
    return true;
  const NearAll near(than);
  return std::any_of(regions.begin(), regions.end(), [&](const Region& region) {
    const auto is_near = [&, limit = limit_um(region)](const Ring& ring) { return near.of(ring, limit); };
    return !is_near(region.outer) || !std::all_of(region.holes.begin(), region.holes.end(), is_near);
  });
}

}  // namespace weft::support
