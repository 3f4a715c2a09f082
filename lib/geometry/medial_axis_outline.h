#pragma once
#include "core/polygon.h"

#include <cstdint>
#include <vector>

/// Private to medial_axis: an outline of which it is proven that no two of its segments meet but in common end points.
namespace weft::geometry::detail {

/// A point on the grid of 1/64 µm around an origin.
struct GridPoint {
  std::int64_t x = 0, y = 0;
  friend constexpr bool operator==(GridPoint, GridPoint) = default;
  friend constexpr auto operator<=>(GridPoint, GridPoint) = default;
};
inline constexpr std::int64_t grid_steps = 64;

struct Outline {
  std::vector<GridPoint> points;                                  ///< distinct
  std::vector<std::pair<std::uint32_t, std::uint32_t>> segments;  ///< material on the left
  bool simple = false;                                            ///< proven
};

/// Pre: |coordinates - origin| <= 2²⁴ µm.
Outline simple_outline(const Region& region, Point origin);

}  // namespace weft::geometry::detail
