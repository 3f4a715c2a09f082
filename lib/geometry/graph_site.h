// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>

/// Private to medial_axis.
namespace weft::geometry::detail {

/// What one vertex of the segment Delaunay graph stands for: a point of the outline, or an edge between two of them.
struct GraphSite {
  double ax = 0, ay = 0, bx = 0, by = 0;  ///< µm; b is a for a point
  std::uint32_t a = 0, b = 0;             ///< indices of points
  bool edge = false;
  bool ends_in(std::uint32_t point) const { return a == point || b == point; }
};

}  // namespace weft::geometry::detail
