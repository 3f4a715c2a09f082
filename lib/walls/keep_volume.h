// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"

/// Private to walls: beads lay what their part asks for.
namespace weft::walls {

/// What beads cover, mm²: their volume at a height of 1 mm.
double laid_mm2(const Beads& beads);

/// What turns, tips and branches lay too much or too little is taken from all beads of a part, by width, or by flow
/// where it is reduced: its volume is right within 0.3 %, as far as `widest` allows and single beads, which gain
/// little. `wanted`: the area to be covered, mm². `widest`: no bead gets wider, µm. `dab`: the part is smaller than the
/// bead, which then may gain. Returns how many times as wide beads were asked to be: 1 when nothing was changed.
double keep_volume(double wanted, Um widest, bool dab, Beads& beads);

}  // namespace weft::walls
