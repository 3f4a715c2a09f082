// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/groups/travel.h"
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
class BlockChain {
 public:
  explicit BlockChain(PathOrder order);
  ~BlockChain();
  BlockChain(const BlockChain&) = delete;
  BlockChain& operator=(const BlockChain&) = delete;

  /// The next layer. Cost: a few tours.
  void add(BlockPlaces layer);
  /// For each layer a permutation of its places. Post: there are no layers.
  std::vector<std::vector<std::uint32_t>> orders();

 private:
  struct Passages;
  PathOrder kind_;
  std::vector<Passages> layers_;
  std::vector<Point> exits_;      // of the passages of the last layer that has any
  std::vector<double> costs_{0};  // beside exits_; one without a place before the first layer
};

}  // namespace weft::travel
