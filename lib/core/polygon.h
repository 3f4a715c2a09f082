// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/point.h"

#include <algorithm>
#include <span>
#include <vector>

namespace weft {

/// An open chain of points.
using Polyline = std::vector<Point>;

/// A closed chain: the last point is joined to the first and is not repeated.
using Ring = std::vector<Point>;

/// Material with its holes. outer is counter-clockwise, holes are clockwise; rings may touch but do not cross.
struct Region {
  Ring outer;
  std::vector<Ring> holes;
  friend bool operator==(const Region&, const Region&) = default;
};
using Regions = std::vector<Region>;

/// An axis-aligned box; empty when min > max.
struct Box {
  Point min{max_coord, max_coord}, max{-max_coord, -max_coord};
  friend constexpr bool operator==(const Box&, const Box&) = default;
  constexpr bool empty() const { return min.x > max.x || min.y > max.y; }
  constexpr Point size() const { return max - min; }
  constexpr Point centre() const { return {min.x + (max.x - min.x) / 2, min.y + (max.y - min.y) / 2}; }
  constexpr void add(Point p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y)};
  }
  constexpr void add(const Box& other) {
    if (!other.empty()) add(other.min), add(other.max);
  }
  constexpr Box grown(Um by) const { return {{min.x - by, min.y - by}, {max.x + by, max.y + by}}; }
  constexpr bool contains(Point p) const { return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y; }
  constexpr bool overlaps(const Box& o) const {
    return min.x <= o.max.x && o.min.x <= max.x && min.y <= o.max.y && o.min.y <= max.y;
  }
};

Box box_of(std::span<const Point> points);
Box box_of(const Regions& regions);

/// Twice the signed area, µm²; > 0 when counter-clockwise. Exact.
std::int64_t double_area(const Ring& ring);

/// Area of the outer ring less its holes, mm². Pre: orientation as Region says.
double area_mm2(const Region& region);
double area_mm2(const Regions& regions);

/// Length along the points, fractional microns. For a ring the closing edge counts.
double length_of(const Polyline& line);
double perimeter_of(const Ring& ring);

/// Where p lies relative to the ring, by crossing number; points on the ring are `on`. Exact. O(n).
enum class Side { outside, on, inside };
Side side_of(const Ring& ring, Point p);
/// Relative to the region: what lies in one of its holes is outside.
Side side_of(const Region& region, Point p);

/// The same regions, every point moved by `by`.
Regions moved(Regions regions, Point by);

}  // namespace weft
