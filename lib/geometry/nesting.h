// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/boolean.h"
#include "geometry/ring_edges.h"

#include <optional>
#include <span>

/// From rings that do not cross to regions, without moving a point; private to geometry/.
/// Rings below tolerances::sliver_area_um2 are left out, with the holes in them.
/// Cost: O(n); about 20 ns a vertex, the edges included.
namespace weft::geometry {

/// What `regions_from_rings` finds for rings that have no point in common with each other nor with themselves. Exact.
/// Pre: no collinear points in the rings (simplify.h), no empty ring; `edges` were made from them.
Regions nested(std::span<const Ring> rings, const RingEdges& edges, WindingRule rule);

/// Holes (clockwise) sorted into the innermost outer ring (counter-clockwise) around them.
/// Pre: rings do not cross, but may touch; `edges` were made from them.
Regions nested_by_orientation(std::span<const Ring> rings, const RingEdges& edges);

/// What either makes of one ring that runs round something convex, as discs do, and most that grows or shrinks one:
/// nothing need be asked. Nothing where the rings are not that.
std::optional<Regions> convex_alone(std::span<const Ring> rings);

}  // namespace weft::geometry
