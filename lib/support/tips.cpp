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

/// The rim of a contact, point by point.
class Rim {
 public:
  Rim(const Regions& contact, const Regions& around, double step) : around_(around), all_free_(around.empty()) {
    for (const Region& region : contact) {
      add(region.outer, step);
      for (const Ring& hole : region.holes) add(hole, step);
    }
  }
  const std::vector<std::vector<Point>>& rings() const { return rings_; }
  bool hangs_free(Point p) const {
    constexpr double inside = 150;  // further from the rim of all of them
    return all_free_ || !around_.region_at(p) || around_.nearest(p, inside);
  }

 private:
  void add(const Ring& line, double step) {
    auto& points = rings_.emplace_back();
    for (std::size_t i = 0; i < line.size(); ++i) {
      const Point a = line[i], b = line[(i + 1) % line.size()];
      const int pieces = std::max(1, static_cast<int>(distance(a, b) / step));
      for (int k = 0; k < pieces; ++k) points.push_back(lerp(a, b, static_cast<double>(k) / pieces));
    }
  }
  geometry::SegmentIndex around_;
  bool all_free_;
  std::vector<std::vector<Point>> rings_;
};

}  // namespace

std::vector<Point> tips_under(const Regions& contact, const Regions& around, const std::vector<Point>& standing,
                              TipSpacing spacing, const Field& field, std::size_t slab, Um radius) {
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
  const Point from = field.origin();  // the lattice goes with the object
  for (Um row = floor_div(box.min.y - from.y, up); row * up <= box.max.y - from.y; ++row) {
    stop_if_asked();
    const Um shift = from.x + (row % 2 != 0 ? across / 2 : 0);
    for (Um column = floor_div(box.min.x - shift, across); column * across + shift <= box.max.x; ++column) {
      const Point p{column * across + shift, row * up + from.y};
      if (inside.region_at(p) && field.to_anything(slab, p) >= radius && !held.any(p)) put(p);
    }
  }
  // Then the rim, where branches find a way, and at last where they may not. A tip stands as far ahead of the first
  // place that none holds as lets it hold that place too.
  const Rim rim(contact, around, std::max(200.0, spacing.rim / 4.0));
  for (const bool must_be_free : {true, false}) {
    const auto may = [&](Point p) { return !must_be_free || field.to_anything(slab, p) >= radius; };
    for (const auto& points : rim.rings()) {
      stop_if_asked();
      for (std::size_t i = 0; i < points.size(); ++i) {
        if (!may(points[i])) continue;
        const bool free = rim.hangs_free(points[i]);
        if (free ? held_at_rim.any(points[i]) : held.any(points[i])) continue;
        const double within = 0.9 * (free ? spacing.rim : spacing.inside);
        Point at = points[i];
        for (std::size_t j = i + 1; j < points.size() && distance(points[i], points[j]) <= within; ++j)
          if (may(points[j])) at = points[j];
        put(at);
      }
    }
  }
  return out;
}

}  // namespace weft::support
