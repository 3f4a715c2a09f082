// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <atomic>
#include <cstddef>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace weft::pipeline {

/// Bytes. Less than that is kept for what comes: it would be given back hole by hole and asked for again page by page.
/// To keep four times as much made ten slices together no faster, and each up to 4 MB larger.
inline constexpr std::size_t worth_giving_back = std::size_t{4} << 20U;

/// Gives back to the system what has been used and freed in pieces, before as much is taken again. Cost: a look at all
/// pieces that are free, and for each hole of a page or more a call of the system (40 to 75 µs on a virtual machine),
/// and faults of the pages that are used again.
inline void give_back_memory() {
#ifdef __GLIBC__
#if __GLIBC_PREREQ(2, 33)
  if (mallinfo2().fordblks < worth_giving_back) return;
#endif
  malloc_trim(0);
#endif
}

/// Gives back where pieces are let go of one after the other, each time that they come to what is worth it.
class GiveBackNowAndThen {
 public:
  /// May be called by several threads.
  void let_go_of(std::size_t bytes) {
    const std::size_t before = bytes_.fetch_add(bytes, std::memory_order_relaxed);
    if (before / worth_giving_back != (before + bytes) / worth_giving_back) give_back_memory();
  }

 private:
  std::atomic<std::size_t> bytes_ = 0;
};

}  // namespace weft::pipeline
