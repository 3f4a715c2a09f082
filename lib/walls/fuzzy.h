// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"
#include "settings/groups/walls.h"

#include <cstddef>
#include <functional>

/// Private to walls: rough walls.
namespace weft::walls {

/// Makes a closed outermost bead rough: points along it, magic_fuzzy_skin_point_dist apart on average, stand off to
/// either side by up to magic_fuzzy_skin_thickness; with FuzzyMode::width its outer edge does, and its inner edge
/// stays. Corners stay where they are, and so does what `keeps` says. What stands off how far is reckoned from the
/// seed, the layer and the number of the bead, so that neither threads nor places matter.
/// @param index of the layer
/// @param number of the bead in its layer
/// Pre: the bead runs counter-clockwise around what is solid, and clockwise around holes. A bead too short for three
/// points stays as it is.
void roughen(const WallSettings& settings, std::size_t index, std::size_t number,
             const std::function<bool(Point)>& keeps, Bead& bead);

/// Is it an outline, and no hole's? Pre: a closed bead.
bool runs_outside(const Bead& bead);

}  // namespace weft::walls
