// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace weft {

/// The convex hull, counter-clockwise, without collinear points; fewer than three points when they all lie on a line.
/// Cost: O(n log n). Exact. Source: Andrew 1979, "Another efficient algorithm for convex hulls in two dimensions".
Ring convex_hull(std::vector<Point> points);

/// Whether the ring turns right nowhere; straight places are allowed. Pre: simple, counter-clockwise. O(n), exact.
bool is_convex(const Ring& ring);

/// The outermost points in eight directions. What lies strictly within the octagon of them is no corner of the hull,
/// and need not be sorted. Source: Akl & Toussaint 1978, "A fast convex hull algorithm".
class Outermost {
 public:
  void add(Point p) {
    if (points_.empty()) points_.assign(8, p);
    for (std::size_t d = 0; d < 4; ++d) {
      Point &most = points_[d], &least = points_[d + 4];
      if (along(p, d) > along(most, d)) most = p;
      if (along(p, d) < along(least, d)) least = p;
    }
  }
  void add(const Outermost& others) {
    for (const Point p : others.points_) add(p);
  }
  /// Post: convex, counter-clockwise; fewer than three corners when all points lie on a line.
  Ring octagon() const { return convex_hull(points_); }

 private:
  static std::int64_t along(Point p, std::size_t direction) {
    switch (direction) {
      case 0:
        return p.x;
      case 1:
        return std::int64_t{p.x} + p.y;
      case 2:
        return p.y;
      default:
        return std::int64_t{p.y} - p.x;
    }
  }

  std::vector<Point> points_;  // most, then least, in each direction; none when none was added
};

/// Whether p lies in the convex ring and not on it. Pre: counter-clockwise.
inline bool strictly_inside(Point p, std::span<const Point> convex) {
  for (std::size_t i = 0; i < convex.size(); ++i)
    if (orient(convex[i], convex[i + 1 == convex.size() ? 0 : i + 1], p) <= 0) return false;
  return convex.size() > 2;
}

}  // namespace weft
