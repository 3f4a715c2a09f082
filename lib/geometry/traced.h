// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/clipper_door.h"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

/// Booleans of outlines that cross cleanly, without a sweep; private to geometry/.
namespace weft::geometry {

/// Whoever follows outlines from crossing to crossing asks each ring for what lies around it, by a look at all to its
/// left: above so many a sweep is left to do it.
inline constexpr std::size_t most_rings_followed = 2048;

/// What each of several operations leaves of two sets of regions: outers counter-clockwise, holes clockwise, crossings
/// rounded to whole microns, collinear points left out. Nothing where an answer would need more than following
/// outlines from crossing to crossing: where two edges have a point in common otherwise than by crossing properly,
/// where rings of one set cross each other or do not wind as regions do, or where there are many rings.
/// Pre: no operation is exclusive_or. Cost: O(n + k log k), k crossings; about 0.1 µs a vertex, a fifth of a sweep's.
/// Source: Weiler & Atherton 1977, "Hidden surface removal using polygon area sorting", section 4.
std::optional<std::vector<std::vector<Ring>>> traced(std::span<const clipper::Operation> operations, const Regions& a,
                                                     const Regions& b);

}  // namespace weft::geometry
