// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "support/support.h"

#include <vector>

namespace weft::support {

/// What a joist is and how it lies.
struct JoistStyle {
  double strands_rad = 0;  ///< direction of the strands above, against X
  bool one_way = true;     ///< … all of them
  Um longest = 0;          ///< free length that a strand may cross
  Um line = 400;           ///< width of a bead
};

/// Of an area that lies on the tips of branches, what carries the strands above it: a loop along its rim, which is the
/// filler's, and lines from tip to tip across the strands. Of each Delaunay triangle of tips the side that is widest
/// across the strands is one, so whatever strand crosses the triangle crosses that side.
Joists joists_between(Regions area, const std::vector<Point>& tips, const JoistStyle& style);

/// Lets go of the lines of joists outside of their area.
void clip_joists(Joists& joists, Um line);

}  // namespace weft::support
