// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "plate/plate.h"
#include "settings/settings.h"
#include "travel/spiral.h"
#include "travel/travel.h"

#include <cstddef>
#include <span>
#include <vector>

/// magic_spiralize: which layers of a plate are turns of a vase, and what becomes of them.
namespace weft::pipeline {

/// What a vase is printed with: one wall, and nothing in it.
Settings of_vase(Settings settings);

/// @throws Error{settings} where what is asked for is no vase: several objects at once, tools, support
void check_vase(const Settings& settings, const Plate& plate);

travel::SpiralStyle spiral_style(const LayerSettings& layers);

/// The layers [begin, end) that are turns.
struct Vase {
  std::size_t begin = 0, end = 0;
  bool has(std::size_t layer) const { return layer >= begin && layer < end; }
};

/// Upwards in the order of the file: one a rise.
using Vases = std::vector<Vase>;

/// Which of them a layer is a turn of; null: none.
const Vase* vase_at(const Vases& vases, std::size_t layer);

/// Takes everything but walls out of the layers above the bottom of each rise, and finds those that are one closed
/// wall, from the first on. A layer that is not ends the vase, with a notice: from there on layers are plain.
Vases vases_of(const Settings& settings, std::span<travel::LayerInput> layers, Notices& notices);

/// Puts a turn in the place of what travel made of a layer; the ways to the first turn stay.
/// Pre: called with the layers of the vase in order. `wall`: that of the layer
void wind(const Vase& vase, std::size_t layer, const Bead& wall, travel::Spiral& spiral, LayerPlan& plan);

/// The wall of a layer that is a turn.
const Bead& wall_of(const travel::LayerInput& layer);

}  // namespace weft::pipeline
