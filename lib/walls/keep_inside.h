// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "walls/finish.h"

#include <vector>

/// Private to walls: single beads stay within the part.
namespace weft::walls {

/// A single bead that reaches over the outline on one side gets as wide as there is room for on both, in a part that
/// has no other walls and in arms of one that has. (What lies between walls with both ends is left as it is.) In a part
/// of single beads what that leaves out is taken up by beads that have room for it, or else by all of them, over the
/// outline if need be: corners that are left get no beads of their own, which would be dabs with two travels each. Pre:
/// finished lines, all there are of the part.
void keep_inside(const Region& region, const FinishOptions& options, std::vector<Line>& lines);

}  // namespace weft::walls
