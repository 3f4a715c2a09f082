// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <span>

namespace weft::geometry {

/// The same inside of a box, with fewer corners: what is cut, offset or asked for inside of it needs no more.
/// Post: winding numbers of points inside the box are as before; outside they may be anything, and rings may cross
///       there. No corner is new, and whoever offsets gives a box that is larger by the offset.
/// Cost: O(n); sweeps over what is left cost by its corners.
Regions trimmed(std::span<const Region> regions, const Box& box);

}  // namespace weft::geometry
