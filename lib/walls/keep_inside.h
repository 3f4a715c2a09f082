#pragma once
#include "core/polygon.h"
#include "walls/finish.h"

#include <vector>

/// Private to walls: the beads of a part that is hardly wider than one stay within it.
namespace weft::walls {

/// A bead that reaches over the outline on one side gets as wide as there is room for on both. What that leaves out is
/// taken up by beads that have room for it; what is left of the part beyond that gets short beads of its own. Where
/// they would be too thin or too short to be laid the beads there are keep the part's volume, over its outline if need
/// be. Pre: finished lines, all there are of the part; open, of inset 0.
void keep_inside(const Region& region, const FinishOptions& options, std::vector<Line>& lines);

}  // namespace weft::walls
