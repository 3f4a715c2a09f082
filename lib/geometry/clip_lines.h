// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "geometry/spatial_index.h"

#include <span>

namespace weft::geometry {

enum class Keep { inside, outside };

/// A piece of a line.
struct Piece {
  Polyline line;           ///< at least two points, in the direction of the line it came from
  std::size_t source = 0;  ///< index of that line
};

/// The pieces of open lines inside (or outside) of regions, in the order of the lines and along each line.
/// Cuts are exact but for the rounding of their place to the nearest micron; a line along an edge of the regions falls
/// on either side. Pre:  `outlines` was made from regions. Cost: by the cells of the index that the lines run through;
/// about 100 ns a cell.
std::vector<Piece> clip_lines(std::span<const Polyline> lines, const SegmentIndex& outlines, Keep keep = Keep::inside);
std::vector<Piece> clip_lines(std::span<const Polyline> lines, const Regions& regions, Keep keep = Keep::inside);

}  // namespace weft::geometry
