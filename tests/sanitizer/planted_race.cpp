// SPDX-License-Identifier: GPL-3.0-or-later
// Has tasks of parallel_map write to one variable: the thread sanitizer must see it, or its silence about the rest of
// weft says nothing.
#include "tasks/parallel.h"

#include <atomic>
#include <chrono>
#include <cstdio>
#include <thread>

int main() {
  std::atomic<int> begun = 0;
  std::size_t shared = 0;
  const auto latest = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  weft::tasks::parallel_map(8, [&](std::size_t i) {
    begun.fetch_add(1, std::memory_order_relaxed);  // which orders nothing
    while (begun.load(std::memory_order_relaxed) < 2 && std::chrono::steady_clock::now() < latest)
      std::this_thread::yield();
    shared += i;
    return i;
  });
  std::printf("%zu\n", shared);
}
