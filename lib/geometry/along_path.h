// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/spatial_index.h"

#include <span>
#include <vector>

namespace weft::geometry {

/// Of places along a path, each near the one before it, what SegmentIndex tells of each: those that follow each other
/// are asked for together, as mostly no segment is near any of them, or the same ones are near them all.
/// Whether a segment is no further away than that.
std::vector<char> lie_near(std::span<const Point> places, const SegmentIndex& segments, double within);
/// Whether it lies in any of the index's regions.
std::vector<char> lie_within(std::span<const Point> places, const SegmentIndex& regions);

}  // namespace weft::geometry
