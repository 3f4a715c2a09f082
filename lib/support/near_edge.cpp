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

  bool of(const Ring& ring, double limit_um) {
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
  /// How far the edge is from p; or how far that is of it which lies beside the place that was asked for before, where
  /// it is near enough to tell.
  std::optional<double> distance_to(Point p, double limit_um) {
    constexpr std::size_t soon = 4;
    const auto edges = edge_.segments();
    double least_um = limit_um / 2;
    std::optional<std::size_t> near;
    for (std::size_t i = last_; i < std::min(last_ + soon, edges.size()); ++i)
      if (const double um = geometry::foot_of(p, edges[i]).distance_um; um < least_um) least_um = um, near = i;
    if (near) return last_ = *near, least_um;
    const auto found = edge_.nearest(p, limit_um);
    if (!found) return std::nullopt;
    last_ = found->segment;
    return found->distance_um;
  }
  bool between(Point a, double from, Point b, double to, double limit_um) {
    constexpr double shortest_um = 20;
    const double length = distance(a, b);
    if (from + to + length <= 2 * limit_um) return true;
    if (length < shortest_um) return false;
    const Point middle = lerp(a, b, 0.5);
    const auto there = distance_to(middle, limit_um);
    return there && between(a, from, middle, *there, limit_um) && between(middle, *there, b, to, limit_um);
  }

  geometry::SegmentIndex edge_;
  std::size_t last_ = 0;
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
  NearAll near(than);
  return std::any_of(regions.begin(), regions.end(), [&](const Region& region) {
    const auto is_near = [&, limit = limit_um(region)](const Ring& ring) { return near.of(ring, limit); };
    return !is_near(region.outer) || !std::all_of(region.holes.begin(), region.holes.end(), is_near);
  });
}

bool are_reached(const Region& region, const Regions& beside, Um by) {
  return area_mm2(beside) < area_mm2(region) && std::all_of(beside.begin(), beside.end(), [by](const Region& piece) {
           const Point size = box_of(piece.outer).size();
           return std::hypot(size.x, size.y) < by;
         });
}

}  // namespace weft::support
