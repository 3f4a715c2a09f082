// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <span>

namespace weft::geometry {

/// Removes repeated points, points on the straight line between their neighbours, and spikes of no width. Exact.
/// A ring without area becomes empty. Cost: O(n).
void drop_collinear(Ring& ring);
/// The same for an open line; its ends stay.
void drop_collinear_of_line(Polyline& line);

/// The line with fewer points: the Hausdorff distance to the original is at most `bound`; ends and remaining points are
/// points of the original. Cost: O(n).
/// Source: greedy with a cone of admissible directions: Sklansky & Gonzalez 1980, "Fast polygonal approximation of
///         digitized curves"; a point is dropped only when the kept chord passes every dropped point within the bound.
Polyline simplified_line(std::span<const Point> line, Um bound);

/// The same for a ring, whatever area it loses; one that would collapse keeps its points.
Ring coarsened(const Ring& ring, Um bound);
/// The same for all rings of regions, which may cross then: for judgements, and for what is offset by more than that.
Regions coarsened(const Regions& regions, Um bound);

/// The same for a ring, whose area changes by 0.75 % at most: a small one gets a smaller bound, one that would
/// collapse keeps its points. Cost: O(n) for each bound that is tried, three quarters of the one before.
/// A ring with itself may cross afterwards where it is narrower than 2 × bound; `simplified(Regions)` sees to that.
Ring simplified(const Ring& ring, Um bound);

/// The same for all rings of regions; rings that would then cross keep their points.
/// Pre:  no two edges cross properly. Post: neither do they afterwards.
/// Cost: O(n); about 100 ns a vertex.
Regions simplified(const Regions& regions, Um bound);

}  // namespace weft::geometry
