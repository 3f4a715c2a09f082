// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "walls/trace.h"

#include <vector>

/// Private to walls: the ends of beads on the axis give way to walls that turn back in front of them.
namespace weft::walls {

/// Cuts from the ends of open lines what lies under a closed one of the same inset, and leads ends that should meet one
/// on to it.
void fit_ends(std::vector<Line>& middles, const std::vector<Line>& pairs);

}  // namespace weft::walls
