// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

namespace weft::support {

/// Whether any place of regions that lie outside of others may be further from these than that: where none may, none
/// is. Small ones can be told at a fraction of what it costs to grow what they lie beside.
/// @param by  less what grown rounds
bool any_may_be_further(const Regions& regions, const Regions& than, Um by);

/// Whether what of a region does not lie on something is only pieces that reach no further than that from it.
/// @param beside  these pieces: each touches what the region lies on, unless it is all of the region
bool are_reached(const Region& region, const Regions& beside, Um by);

}  // namespace weft::support
