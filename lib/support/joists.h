// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "support/support.h"

#include <functional>
#include <vector>

namespace weft::support {

/// What a joist is and how it lies.
struct JoistStyle {
  double strands_rad = 0;  ///< direction of the strands above, against X
  bool one_way = true;     ///< … all of them
  Um longest = 0;          ///< free length that a strand may cross
  Um line = 400;           ///< width of a bead
};

/// What joists lie on and between.
struct JoistPlace {
  std::vector<Point> tips;                 ///< middles of branches
  Regions below;                           ///< what lies on the level below
  Regions beside;                          ///< roofs of the same level
  std::function<bool(Point, Point)> free;  ///< whether a line may run there outside of the area
};

/// Of an area that lies on the tips of branches, what carries the strands above it: its rim, where that lies on
/// something every so often, and lines from tip to tip across the strands. Of each Delaunay triangle of tips the side
/// that is widest across the strands is one, so whatever strand crosses the triangle crosses that side. Lines run on to
/// branches beyond the rim, or their ends would hang. Where a branch stands alone and the rim does not lie on it, two
/// lines that cross there carry the rim.
Joists joists_between(Regions area, const JoistPlace& place, const JoistStyle& style);

}  // namespace weft::support
