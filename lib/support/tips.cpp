// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/tips.h"

#include "core/stop.h"
#include "geometry/spatial_index.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace weft::support {
namespace {

/// Points by cell of a grid as wide as what is asked for.
class NearPoints {
 public:
  explicit NearPoints(Um within) : cell_(std::max<Um>(within, 100)), within2_(std::int64_t{within} * within) {}
  void add(Point p) { cells_[key(column(p.x), column(p.y))].push_back(p); }
  bool any(Point p) const {
    for (Um dy = -1; dy <= 1; ++dy)
      for (Um dx = -1; dx <= 1; ++dx) {
        const auto found = cells_.find(key(column(p.x) + dx, column(p.y) + dy));
        if (found == cells_.end()) continue;
        for (const Point q : found->second)
          if (distance2(p, q) <= within2_) return true;
      }
    return false;
  }

 private:
  Um column(Um v) const { return v >= 0 ? v / cell_ : -((-v + cell_ - 1) / cell_); }
  static std::int64_t key(Um c, Um r) { return (std::int64_t{c} << 32) ^ static_cast<std::uint32_t>(r); }
  Um cell_;
  std::int64_t within2_;
  std::unordered_map<std::int64_t, std::vector<Point>> cells_;  // looked up only: its order shows nowhere
};

}  // namespace

std::vector<Point> tips_under(const Regions& contact, const std::vector<Point>& standing, TipSpacing spacing,
                              const Field& field, std::size_t slab, Um radius) {
  const Um covers = spacing.inside;
  const Box box = box_of(contact);
  NearPoints held(covers), held_at_rim(spacing.rim);
  std::vector<Point> out;
  const auto hold = [&](Point p) { held.add(p), held_at_rim.add(p); };
  const auto put = [&](Point p) { out.push_back(p), hold(p); };
  for (const Point p : standing)
    if (box.grown(covers).contains(p)) hold(p);
  const geometry::SegmentIndex inside(contact);
  // The middle of three points of such a lattice is 0.92 of what one covers away from each.
  const Um across = covers * 16 / 10, up = covers * 139 / 100;
  const auto floor_div = [](Um v, Um by) { return v >= 0 ? v / by : -((-v + by - 1) / by); };
  for (Um row = floor_div(box.min.y, up); row * up <= box.max.y; ++row) {
    stop_if_asked();
    const Um shift = row % 2 != 0 ? across / 2 : 0;
    for (Um column = floor_div(box.min.x - shift, across); column * across + shift <= box.max.x; ++column) {
      const Point p{column * across + shift, row * up};
      if (inside.region_at(p) && field.to_anything(slab, p) >= radius && !held.any(p)) put(p);
    }
  }
  // Then the rim, where branches find a way, and at last where they may not.
  const double step = std::max(200.0, spacing.rim / 4.0);
  for (const bool free : {true, false})
    for (const Region& region : contact) {
      stop_if_asked();
      for (std::size_t ring = 0; ring <= region.holes.size(); ++ring) {
        const Ring& line = ring == 0 ? region.outer : region.holes[ring - 1];
        for (std::size_t i = 0; i < line.size(); ++i) {
          const Point a = line[i], b = line[(i + 1) % line.size()];
          const int pieces = std::max(1, static_cast<int>(distance(a, b) / step));
          for (int k = 0; k < pieces; ++k) {
            const Point p = lerp(a, b, static_cast<double>(k) / pieces);
            if ((!free || field.to_anything(slab, p) >= radius) && !held_at_rim.any(p)) put(p);
          }
        }
      }
    }
  return out;
}

}  // namespace weft::support
