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
  bool small = false;           ///< many are branches of support: it does not matter which of them ends the layer
};

/// An order of places, shortened by local moves.
std::vector<std::uint32_t> shortened(const std::vector<Point>& places, const std::vector<std::uint32_t>& order,
                                     const TourEnds& ends);

/// The order of the blocks of every layer.
///
/// A layer is entered at one of a few blocks and left at one of a few, with the shortest order between; which ones is
/// chosen for all layers at once by dynamic programming, so that a layer ends where the next may well begin. Layers of
/// many blocks are ordered one after the other, those of small ones like one of the last below that had nearly the
/// same.
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
  std::vector<std::uint32_t> one_way(const std::vector<Point>& places, const TourEnds& ends);

  PathOrder kind_;
  std::vector<Passages> layers_;
  std::vector<Point> exits_;               // of the passages of the last layer that has any
  std::vector<double> costs_{0};           // beside exits_; one without a place before the first layer
  std::vector<std::vector<Point>> below_;  // the places of the last layers of small blocks, in their order
  int like_below_ = 0;                     // so many layers were ordered like one below them
};

}  // namespace weft::travel
