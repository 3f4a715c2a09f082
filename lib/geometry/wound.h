// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "geometry/boolean.h"

#include <optional>
#include <span>

/// What rings wind around that cross themselves and each other cleanly, without a sweep; private to geometry/.
namespace weft::geometry {

/// What `regions_from_rings` finds; nothing where an answer would need more than following rings from crossing to
/// crossing: where two edges have a point in common otherwise than by crossing properly, where rings that cross wind
/// around something negatively and that is to count, or where there are many of them.
/// Pre: no ring is empty or has collinear points (simplify.h). Where none crosses, none of their points moves.
/// @param origin  of the grid that is swept where rounding to whole microns made outlines cross
/// Cost: O(n + k log k), k crossings.
/// Source: Chen & McMains 2005, "Polygon offsetting by computing winding numbers".
std::optional<Regions> wound(std::span<const Ring> rings, WindingRule rule, Point origin);

}  // namespace weft::geometry
