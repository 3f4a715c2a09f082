// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "core/tolerances.h"

namespace weft::geometry {

/// What becomes of a corner that opens a gap between its two offset edges.
enum class Corner {
  miter,  ///< the edges are prolonged until they meet; beyond the miter limit cut square at distance `by`
  bevel,  ///< the ends of the edges are joined
  round,  ///< an arc of radius `by`
};

struct OffsetOptions {
  Um by = 0;  ///< outwards; negative shrinks
  Corner corner = Corner::miter;
  double miter_limit = 2.0;            ///< longest miter, as a multiple of `by`; at least 1
  Um arc_tolerance = tolerances::arc;  ///< how far the arc's polygon may be from the arc; at least 1
};

/// The regions grown (or shrunk) by a distance; parts that meet become one, what is thinner than twice the distance
/// goes. Pre:    orientation as Region says; parts may overlap. Post:   as for Booleans (geometry/boolean.h). Cost:
/// O((n + k) log n), about 0.5 µs a vertex. Source: raw offset curve as in Chen & McMains 2005, "Polygon offsetting by
/// computing winding numbers"; what has a
///         positive winding number is kept (Clipper 6.4).
Regions offset(const Regions& regions, const OffsetOptions& options);

/// Shrunk by `radius` and grown again: drops what is thinner than twice the radius. Contained in `regions` up to a
/// micron.
Regions opening(const Regions& regions, Um radius, Corner corner = Corner::round);

/// Grown by `radius` and shrunk again: closes gaps narrower than twice the radius. Contains `regions` up to a micron.
Regions closing(const Regions& regions, Um radius, Corner corner = Corner::round);

}  // namespace weft::geometry
