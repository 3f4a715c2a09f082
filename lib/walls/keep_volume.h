// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"

/// Private to walls: beads lay what their part asks for.
namespace weft::walls {

/// What turns, tips and branches lay too much or too little is taken from all beads of a part, by width, or by flow
/// where it is reduced: its volume is right within 0.3 %, as far as `widest` allows and single beads, which gain
/// little. `wanted`: the area to be covered, mm². `widest`: no bead gets wider, µm. `dab`: the part is smaller than the
/// bead, which then may gain.
void keep_volume(double wanted, Um widest, bool dab, Beads& beads);

}  // namespace weft::walls
