#pragma once
#include "settings/travel.h"
#include "travel/tour.h"

#include <optional>
#include <span>
#include <vector>

namespace weft::travel {

/// The blocks of a layer as places.
struct BlockPlaces {
  std::vector<Point> places;
  std::optional<Point> before;  ///< where the nozzle must go first on this layer
};

/// The order of the blocks of every layer.
///
/// A layer is entered at one of a few blocks and left at one of a few, with the shortest order between; which ones is
/// chosen for all layers at once by dynamic programming, so that a layer ends where the next may well begin. Layers of
/// many blocks are ordered one after the other.
/// Post: for each layer a permutation of its places. Cost: O(layers), a few tours each.
std::vector<std::vector<std::uint32_t>> chain_blocks(PathOrder order, std::span<const BlockPlaces> layers);

}  // namespace weft::travel
