// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "geometry/spatial_index.h"

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

/// What rings wind around that cross themselves and each other cleanly, without a sweep; private to geometry/.
namespace weft::geometry {

/// The outlines of what the rings wind around positively: outers counter-clockwise, holes clockwise, crossings rounded
/// to whole microns, collinear points left out; where several pieces lie at one corner, outlines may touch there.
/// Nothing where there are many rings, or where doubles do not tell in which order crossings come.
/// Pre: `index` was made from the rings, none of which is empty or has collinear points; `crossings` are its clean
/// ones. Cost: O(n + k log k), k crossings; about a fifth of a sweep's. Source: Chen & McMains 2005, "Polygon
/// offsetting by computing winding numbers".
std::optional<std::vector<Ring>> wound(std::span<const Ring> rings, const SegmentIndex& index,
                                       std::span<const std::pair<std::uint32_t, std::uint32_t>> crossings);

}  // namespace weft::geometry
