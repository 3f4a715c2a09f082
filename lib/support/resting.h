// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/room.h"

namespace weft::support {

/// What of the part a level comes to lie on, near the box: beads sink so far.
Regions part_below(const Room& room, const Stack::Level& level, const Box& near);

/// What hangs of a level, or is left out of it, and is no larger is not asked for what it rests on or holds.
inline constexpr double least_to_rest_mm2 = 0.05;

/// How far beads of a level reach beyond what they lie on, µm.
Um reach_of(const Room& room, const Stack::Level& level);

/// Takes away what of a level rests neither on what is below it nor on the part.
/// @return the regions of which nothing is left
Regions rest_on(const Room& room, const Stack::Level& level, const Regions& below, Regions& here);

/// The same; and where nothing of a region rests, over a slope too steep to stand on, it reaches out to where the slope
/// is near below.
/// @param lost  seen from above, with the regions of which nothing rested
/// @return whether it is less than it was
bool rest_or_reach(const Room& room, const Stack::Level& level, const Regions& below, Regions& here, Regions& lost);

}  // namespace weft::support
