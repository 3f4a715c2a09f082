// SPDX-License-Identifier: GPL-3.0-or-later
#include "tasks/threads.h"

#include <algorithm>
#include <latch>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace weft::tasks {
namespace {

/// Begins so many at once. @return how many there were
unsigned begun(unsigned wanted) {
  std::latch asked(1);
  std::vector<std::thread> threads;
  threads.reserve(wanted);
  try {
    while (threads.size() < wanted) threads.emplace_back([&] { asked.wait(); });
  } catch (const std::system_error&) {
  }
  asked.count_down();
  for (auto& thread : threads) thread.join();
  return static_cast<unsigned>(threads.size());
}

}  // namespace

unsigned obtainable(unsigned wanted) {
  static std::mutex mutex;
  static unsigned asked = 1, had = 1;
  const std::lock_guard lock(mutex);
  // Those that were had before may be at work now: only what goes beyond them is asked for.
  if (wanted > asked && had == asked) had += begun(wanted - asked);
  asked = std::max(asked, wanted);
  return std::min(wanted, had);
}

}  // namespace weft::tasks
