// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "infill/layer_area.h"
#include "infill/mask.h"

#include <cstddef>
#include <vector>

namespace weft::infill {

/// A line of a belt: along the wall, as wide all along as any line. A closed one does not repeat its first point.
struct BeltLine {
  Polyline path;
  bool closed = false;
};

/// Under slopes and ledges solid infill is a narrow belt between the wall and sparse infill. Lines at an angle to it
/// would be dabs with a turn between each two; loops along the wall are even, and the same on both sides of a symmetric
/// part.
struct Belts {
  struct Of {
    std::size_t region = 0;  ///< of what is inside of the walls
    std::vector<BeltLine> lines;
    Regions area;  ///< what they cover; reaches over the edge, into the wall
  };
  std::vector<Of> found;  ///< regions ascending, each once
  Mask area;
};

/// Finds belts of no more than about five lines' width (`widest_strip`) and lays lines along the wall in them: the one
/// in depth (k − ½) · band runs where the belt is at least that wide. A belt's inner edge follows from what lies layers
/// away and is not seen: it moves to the edge of the last line, by half a line at most. So a belt below half a line has
/// none: there the skin lacks a layer, or a wall lies beside what carries it with less than half of a line. A line
/// begins and ends where the belt is that wide, by outlines where cells leave it in doubt: a wall that turns a corner
/// above lies on all of it. Lines that are about as long as the shortest are kept or left out together: so equal places
/// are alike, however the grid lies on them.
/// @param inside of the walls, exactly
/// @param solid,sparse cells of it; what is too narrow for a line of its own is solid, too
/// @param layers what decides which is which
/// @param band of a line, µm
/// Cost: three offsets of the regions that have such belts, one of those that could; where a width is in doubt, the
/// edges of the layers in reach beside it.
Belts find_belts(const Regions& inside, const Mask& solid, const Mask& sparse, const LayersInReach& layers, Um band);

}  // namespace weft::infill
