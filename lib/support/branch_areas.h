// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/room.h"

#include <vector>

namespace weft::support {

/// A branch on one level.
struct Disc {
  Point at;
  double radius = 0;  ///< µm
};

/// Its outline, counter-clockwise, around it. Corners turn by so little that a printer need not slow down at them.
Ring circle_around(const Disc& disc);

/// The areas of branches by level: discs less what is kept out, and what of them rests.
/// Cost: discs that stand free of each other and of the part cost nothing but their corners.
std::vector<Regions> branch_areas(const Room& room, const Stack& stack, const std::vector<Regions>& contacts,
                                  const std::vector<std::vector<Disc>>& discs);

}  // namespace weft::support
