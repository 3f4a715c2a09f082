// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "travel/travel.h"

/// Private to travel: what combing goes by, before settings move it or take from it.
namespace weft::travel {

/// Of each part: what its outer walls' centrelines enclose, and the bands of those that are open; of a part without
/// outer walls its outline, as far as its infill reaches. `by`: how far the boundaries that walls make are moved
/// outwards; the others stay.
Regions comb_base(const LayerInput& input, Um by);

/// Whether every part has closed outer walls and no others: then the base is what their rings enclose.
bool all_closed(const LayerInput& input);

}  // namespace weft::travel
