// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <cstddef>

namespace weft::tasks {

/// Cuts a row into blocks of neighbours. How many there are depends on the row alone, never on the threads: what is put
/// together block by block is the same on any number of them.
class Blocks {
 public:
  /// @param length       of the row
  /// @param block_length of a block that is worth a task. Pre: > 0
  /// @param most         so many blocks at most, which then are longer. Pre: > 0
  Blocks(std::size_t length, std::size_t block_length, std::size_t most)
      : length_(length), count_(std::min(most, (length + block_length - 1) / block_length)) {}

  std::size_t count() const { return count_; }
  std::size_t begin(std::size_t block) const { return length_ / count_ * block + std::min(block, length_ % count_); }
  std::size_t end(std::size_t block) const { return begin(block + 1); }

 private:
  std::size_t length_, count_;
};

}  // namespace weft::tasks
