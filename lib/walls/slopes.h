// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "walls/beading.h"

#include <vector>

/// Private to walls: parts whose walls go further in, for the walls of the layer above.
namespace weft::walls {

/// How many more walls each region gets: as many as it takes until no more than a third of the outline above it lies
/// where its outer wall would hang over the inside, one and a half walls deep at the most. Further in is a top surface,
/// which has its own skin below it.
/// Cost: four offsets and a clipping of the outline above for each region and wall added.
std::vector<int> extra_walls(const Widths& widths, const Regions& regions, const Regions& above);

}  // namespace weft::walls
