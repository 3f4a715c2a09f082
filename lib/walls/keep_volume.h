#pragma once
#include "model/bead.h"

/// Private to walls: beads lay what their part asks for.
namespace weft::walls {

/// What turns, tips and branches lay too much or too little is taken from all beads of a part: its volume is right.
/// Returns how many times as wide beads are.
/// `wanted`: the area to be covered, mm². `widest`: no bead gets wider, µm. `dab`: the part is smaller than the bead.
double keep_volume(double wanted, Um widest, bool dab, Beads& beads);

}  // namespace weft::walls
