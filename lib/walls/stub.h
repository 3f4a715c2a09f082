// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "walls/trace.h"

#include <vector>

/// Private to walls: the bead of a part, or of what walls leave of one, that is hardly longer than wide.
namespace weft::walls {

/// A straight bead across a ring, from end to end in the direction in which the ring is most alike on both sides of it.
/// Its volume is the ring's area. Widths follow the ring; a side that bends back ends where the bead leaves it.
/// Post: fewer than two vertices if there is no room. The mirror image of a ring gets the mirror image of the bead.
std::vector<Line::Vertex> stub_bead(const std::vector<Place>& ring);

}  // namespace weft::walls
