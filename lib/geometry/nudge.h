// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

namespace weft::geometry {

/// Every corner moved out by so many microns along its miter, and no edge looked at that crosses another then: a few,
/// so that outlines that lie on those of others do not any more, and Booleans follow them instead of sweeping both.
Regions nudged_out(const Regions& regions, Um by);

/// What of a region others do not cover that are a hair wider than they are: a few microns, by which they may then
/// cross. Pre: the region is one, as a Boolean leaves it; others are whole within four hairs of its box. Cost: as of
/// `wound`, or of `subtract` where that cannot tell.
Regions beyond(const Region& region, const Regions& others, Um hair);
/// The same of several that do not overlap.
Regions beyond(const Regions& regions, const Regions& others, Um hair);

/// What of a region others cover, to a hair; all of it as it was where that is all. Pre: as of `beyond`
Regions covered(const Region& region, const Regions& others, Um hair);

}  // namespace weft::geometry
