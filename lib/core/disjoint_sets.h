// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

namespace weft {

/// Which of the numbers 0 … count − 1 belong together: each is alone until it is joined with another. Paths are halved
/// on the way (R. E. Tarjan and J. van Leeuwen, Worst-case analysis of set union algorithms, section 2: path halving);
/// a set goes by its least number, so that what follows from it depends on no order.
class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }

  /// The least number of the set that i is in. Pre: i < count.
  std::size_t of(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  void join(std::size_t a, std::size_t b) {
    a = of(a), b = of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }

 private:
  std::vector<std::size_t> parent_;
};

}  // namespace weft
