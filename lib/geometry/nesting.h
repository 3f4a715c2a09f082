// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/boolean.h"
#include "geometry/spatial_index.h"

#include <optional>
#include <span>

/// From rings that do not cross to regions, without moving a point; private to geometry/.
/// Rings below tolerances::sliver_area_um2 are left out, with the holes in them.
/// Cost: O(n); about 60 ns a vertex, the index included.
namespace weft::geometry {

/// What `regions_from_rings` finds, without a sweep, for rings that have no point in common with each other nor with
/// themselves; nothing when they have. Exact.
/// Pre: no collinear points in the rings (simplify.h), no empty ring.
std::optional<Regions> nested(std::span<const Ring> rings, WindingRule rule);
/// The same where it is known that they have none. Pre: `index` was made from the rings.
Regions nested_apart(std::span<const Ring> rings, const SegmentIndex& index, WindingRule rule);

/// Holes (clockwise) sorted into the innermost outer ring (counter-clockwise) around them.
/// Pre: rings do not cross, but may touch; `index` was made from them.
Regions nested_by_orientation(std::span<const Ring> rings, const SegmentIndex& index);

}  // namespace weft::geometry
