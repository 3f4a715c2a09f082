#pragma once
#include <vector>

#include "core/polygon.h"

namespace weft {

/// The convex hull, counter-clockwise, without collinear points; fewer than three points when they all lie on a line.
/// Cost: O(n log n). Exact. Source: Andrew 1979, "Another efficient algorithm for convex hulls in two dimensions".
Ring convex_hull(std::vector<Point> points);

}  // namespace weft
