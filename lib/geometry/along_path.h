// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/spatial_index.h"

#include <span>
#include <vector>

namespace weft::geometry {

/// Whether each place along a path has a segment no further away than that, µm: as SegmentIndex::nearest tells of one.
/// Places that follow each other are asked for together, as mostly no segment is near any of them, or the same ones are
/// near them all; any places may be asked for, those of a path at least cost.
/// Post: as many as places, 1 for each that has, else 0
std::vector<char> lie_near(std::span<const Point> places, const SegmentIndex& segments, double within);
/// The same of whether each lies in any of the index's regions, as SegmentIndex::region_at tells of one.
std::vector<char> lie_within(std::span<const Point> places, const SegmentIndex& regions);

}  // namespace weft::geometry
