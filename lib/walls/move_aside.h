// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"

#include <span>

/// Private to walls: junctions moved across their bead.
namespace weft::walls {

/// Moves each junction of a closed bead by so many microns to its left, where the part is, midway between its sides'
/// directions; negative: to its right. A sharp corner moves no further, so it does not run off: its sides move less.
void move_left(Bead& bead, std::span<const double> by);

}  // namespace weft::walls
