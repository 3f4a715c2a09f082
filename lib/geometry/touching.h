// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/offset.h"

#include <span>
#include <vector>

namespace weft::geometry {

/// Boxes that meet, directly or by others, together: by their numbers, ascending; sets by their least.
/// Cost: O(n log n + pairs that overlap in x).
std::vector<std::vector<std::size_t>> touching(std::span<const Box> boxes);

/// Regions that overlap or touch, directly or by others, together: by their numbers, ascending; sets by their least.
/// Cost: O(n log n + pairs of edges that meet).
std::vector<std::vector<std::size_t>> overlapping(const Regions& regions);

/// What overlaps or touches becomes one region. Post and errors as for geometry::unite, whose cost regions that stand
/// alone are spared.
Regions joined(const Regions& regions);

/// As geometry::offset, for many regions most of which stay apart: sweeps cost by how many regions they pass at once,
/// and here none passes more than belong together. Regions come in the order of their clusters.
Regions offset_apart(const Regions& regions, const OffsetOptions& options);

}  // namespace weft::geometry
