// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <cstdint>
#include <vector>

/// Private to medial_axis: an outline of which it is proven that no two of its segments meet but in common end points.
namespace weft::geometry::detail {

/// A point on a grid around an origin.
struct GridPoint {
  std::int64_t x = 0, y = 0;
  friend constexpr bool operator==(GridPoint, GridPoint) = default;
  friend constexpr auto operator<=>(GridPoint, GridPoint) = default;
};
inline constexpr std::int64_t grid_steps = 64;      ///< a micron, where crossings are united
inline constexpr std::int64_t shaken_steps = 4096;  ///< a micron, of an outline's points

struct Outline {
  std::vector<GridPoint> points;                                  ///< distinct, in shaken_steps
  std::vector<std::pair<std::uint32_t, std::uint32_t>> segments;  ///< material on the left
  bool simple = false;                                            ///< proven
};

/// Where that keeps it simple, every point is moved by up to 1/256 µm, at random by its place: parts that were drawn
/// symmetric lie on the lattice with four and more edges touching one circle, and there CGAL decides by exact
/// arithmetic, at seven times the cost (8,000 regular octagons). Pre: |coordinates - origin| <= 2²⁴ µm.
Outline simple_outline(const Region& region, Point origin);

}  // namespace weft::geometry::detail
