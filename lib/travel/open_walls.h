// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "travel/tour.h"
#include "travel/travel.h"

#include <span>

namespace weft::travel {

/// Moves open walls to where the nozzle passes by anyway: they lie between other walls and bind no order. The other
/// turns keep theirs.
/// @param turns of one block, walls first
/// Post: the way between the turns is not longer than it was. Cost: O(open walls × log turns) a pass, a few passes.
/// Source: Or 1976 (the moves).
void fit_open_walls(const Beads& beads, std::span<Turn> turns, const TourEnds& ends);

}  // namespace weft::travel
