// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "geometry/place.h"

#include <cstdint>
#include <vector>

namespace weft::geometry {

/// The medial axis of a region: every point with more than one nearest point on the outline, with its clearance.
///
/// It is a planar graph; cutting the region along it leaves one strip for every run of the outline between two convex
/// corners. A half-edge belongs to the strip on its right and runs in the outline's own direction (material on the
/// left). `next` walks along a strip: from one half-edge to the one that follows it over the same outline, and round a
/// convex corner on to the other side of the edge that ends there.
struct MedialAxis {
  struct Node {
    Place at;
    double clearance = 0;  ///< distance to the outline, µm; 0 at a convex corner
  };
  struct Site {  ///< what is nearest on the right of a half-edge: an edge a→b of the outline, or a reflex corner (a ==
                 ///< b)
    Place a, b;
    bool corner = false;
  };
  struct HalfEdge {
    std::uint32_t from = 0, next = 0, site = 0;  ///< node, half-edge, site; it ends where its twin starts
  };
  static constexpr std::uint32_t twin(std::uint32_t half_edge) { return half_edge ^ 1U; }

  Point origin;
  std::vector<Node> nodes;
  std::vector<Site> sites;
  std::vector<HalfEdge> half_edges;  ///< twins are neighbours: 2k and 2k + 1
  bool valid = false;                ///< false: nothing could be proven about the outline, nothing was built
};

/// The medial axis of one region.
/// Pre:    orientation as Region says; anything else may be wrong with it: collinear, double and touching points, rings
///         that cross by rounding. Such an outline is first made simple on a grid 64 times finer than the lattice.
/// Post:   clearances are exact to 0.1 µm; the graph's order is combinatorial, never a matter of rounded coordinates.
/// Cost:   O(n log n), 3 to 4 µs a vertex (tests/benchmark/RESULTS.md).
/// Source: Karavelas 2004, "A robust and efficient implementation for the segment Voronoi diagram" (CGAL).
MedialAxis medial_axis(const Region& region);

}  // namespace weft::geometry
