// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "settings/groups/adhesion.h"

#include <vector>

namespace weft::adhesion {

/// Centrelines of a brim's loops, the outermost first. A ring is closed, a line is what is left of one that was cut.
struct BrimLoop {
  Polyline line;
  bool closed = true;
  int loop = 0;  ///< 0 is nearest to the part
};

/// @param gap    between the part and the first band
/// @param band   width of each of the `count` bands
/// @param others what else stands there: loops that run into it are opened
std::vector<BrimLoop> brim_loops(const Regions& outlines, BrimLocation location, Um gap, double band_um, int count,
                                 const Regions& others = {});

/// The pieces of a loop inside (or outside) of regions; a piece that runs over the loop's start is one piece.
std::vector<BrimLoop> cut_loop(const BrimLoop& loop, const Regions& regions, bool keep_inside);

}  // namespace weft::adhesion
