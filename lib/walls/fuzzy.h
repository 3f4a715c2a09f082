// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"
#include "settings/groups/walls.h"

#include <cstddef>
#include <functional>

/// Private to walls: rough walls.
namespace weft::walls {

/// Which bead it is.
struct FuzzyPlace {
  std::size_t index = 0;   ///< of the layer
  std::size_t number = 0;  ///< of the bead in its layer
  Um z = 0;
  Point origin{};  ///< of the object: what moves with it
};

/// Makes a closed outermost bead rough: points along it, magic_fuzzy_skin_point_dist apart on average, stand off to
/// either side by up to magic_fuzzy_skin_thickness; with FuzzyMode::width its outer edge does, and its inner edge
/// stays. Corners stay where they are, and so does what `keeps` says. Which points stand off, and with
/// FuzzyNoise::classic how far, is reckoned from the seed, the layer and the number of the bead; with other noise how
/// far is what the noise is at the point of the object. So neither threads nor places on the bed matter.
/// Pre: the bead runs counter-clockwise around what is solid, and clockwise around holes. A bead too short for three
/// points stays as it is.
void roughen(const WallSettings& settings, const FuzzyPlace& place, const std::function<bool(Point)>& keeps,
             Bead& bead);

/// Is it an outline, and no hole's? Pre: a closed bead.
bool runs_outside(const Bead& bead);

}  // namespace weft::walls
