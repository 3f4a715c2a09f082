// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "travel/travel.h"

#include <vector>

namespace weft::travel {

/// The beads a block's indices point into.
inline const Beads& beads_of(const LayerInput& input, const Block& block) {
  return block.object == Block::adhesion ? input.adhesion : input.objects[block.object].beads;
}

/// How high its beads are.
inline Um height_of(const LayerInput& input, const Block& block) {
  const Um own = block.object == Block::adhesion ? 0 : input.objects[block.object].height;
  return own > 0 ? own : input.height;
}

/// The blocks of a layer, the adhesion first, parts of an object together.
std::vector<Block> blocks_of(const LayerInput& input);

/// For beads of a block: which of them touch side by side, as pairs of positions in `walls`, the earlier one first.
/// Beads of equal inset never count. Cost: O(n) in the length of the beads.
struct Touch {
  std::uint32_t first, second;
};
std::vector<Touch> touching_walls(const Beads& beads, const std::vector<std::uint32_t>& walls);

}  // namespace weft::travel
