// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <atomic>
#include <cstddef>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace weft::pipeline {

/// Gives back to the system what has been used and freed in pieces, before as much is taken again. Cost: 0.3 to 0.4 ms,
/// and faults of the pages that are used again.
inline void give_back_memory() {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

/// Gives back where pieces are let go of one after the other, each time that they come to what is worth it.
class GiveBackNowAndThen {
 public:
  /// May be called by several threads.
  void let_go_of(std::size_t bytes) {
    const std::size_t before = bytes_.fetch_add(bytes, std::memory_order_relaxed);
    if (before / worth_it != (before + bytes) / worth_it) give_back_memory();
  }

 private:
  static constexpr std::size_t worth_it = std::size_t{1} << 20U;
  std::atomic<std::size_t> bytes_ = 0;
};

}  // namespace weft::pipeline
