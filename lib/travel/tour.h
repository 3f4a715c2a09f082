// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/point.h"
#include "settings/groups/travel.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

/// The order of paths as a travelling-salesman problem: every stop is entered at one end and left at the other.
namespace weft::travel {

/// Something that is printed in one go.
struct Stop {
  Point a, b;
  bool reversible = true;  ///< may also be entered at b and left at a
};

struct Visit {
  std::uint32_t stop = 0;
  bool reversed = false;  ///< entered at b
  friend bool operator==(const Visit&, const Visit&) = default;
};

/// Where the nozzle comes from and where it goes on to; absent: costs nothing.
struct TourEnds {
  std::optional<Point> from, to;
};

/// A permutation of the stops of small total way between them. Deterministic; moving everything moves nothing in it.
/// Post: for `optimized`, never longer than for `nearest`.
/// Cost: O(n) local moves of bounded size: 20 000 stops take a fraction of a second.
/// Source: Bentley 1992, "Fast algorithms for geometric traveling salesman problems" (2-opt and Or-opt with neighbour
///         lists and don't-look bits); Or 1976, Lin & Kernighan 1973 (Or-3opt with positive sums of gains).
std::vector<Visit> tour(PathOrder order, std::span<const Stop> stops, const TourEnds& ends);

/// The same from an order that is nearly as short: local moves only, nothing is tried anew. Never longer than it.
std::vector<Visit> shortened(std::span<const Stop> stops, const std::vector<Visit>& visits, const TourEnds& ends);

/// Length of the way between the stops, and from and to the ends, fractional microns.
double way(std::span<const Stop> stops, std::span<const Visit> visits, const TourEnds& ends);

/// No order of the stops has a shorter way, fractional microns: the least spanning tree over their ends, made dearer
/// where it has more hops than a tour.
/// Cost: O(n²), sixty times: for figures, not for prints.
/// Source: Held & Karp 1970/71, "The traveling-salesman problem and minimum spanning trees" (1-trees).
double least_way(std::span<const Stop> stops, const TourEnds& ends);

}  // namespace weft::travel
