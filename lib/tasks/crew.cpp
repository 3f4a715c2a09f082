// SPDX-License-Identifier: GPL-3.0-or-later
#include "tasks/crew.h"

#include "tasks/hand_over.h"
#include "tasks/threads.h"

#include <mutex>
#include <utility>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

namespace weft::tasks {

unsigned thread_count(unsigned threads) {
  const auto wanted = threads != 0 ? threads : static_cast<unsigned>(tbb::info::default_concurrency());
  const auto had = obtainable(wanted);
  // To the end of the program: TBB would ask for the rest where a limit that is lower ends.
  if (had < wanted) {
    static const auto* const all_there_are = new tbb::global_control(tbb::global_control::max_allowed_parallelism, had);
    (void)all_there_are;
  }
  return had;
}

std::vector<Broken> run_crew(unsigned threads, const std::function<std::optional<std::size_t>()>& next,
                             const std::function<void(std::size_t)>& work) {
  const unsigned places = thread_count(threads);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, places);
  tbb::task_arena arena(static_cast<int>(places));
  tbb::task_group group;
  HandOver hand_over;
  std::mutex mutex;  // guards what follows
  unsigned running = 0;
  std::vector<Broken> broken;
  std::exception_ptr no_next;

  // No error leaves a task: TBB would cancel the loops of all pieces for one that fails.
  std::function<void()> begin_what_may;
  const auto piece = [&](std::size_t index) {
    std::exception_ptr error;
    try {
      // Isolated, or a thread that waits for the last layer of one piece would begin another on top of it.
      tbb::this_task_arena::isolate([&] { work(index); });
    } catch (...) {
      error = std::current_exception();
    }
    {
      const std::lock_guard lock(mutex);
      --running;
      if (error) broken.push_back({index, std::move(error)});  // there is room: it was made when the piece began
    }
    begin_what_may();
  };
  const auto begin_one = [&] {
    const auto index = next();
    if (!index) return false;
    broken.reserve(broken.size() + running + 1);
    hand_over.begin();
    group.run([&, i = *index] {
      const HandOver::Task handed(hand_over);
      piece(i);
    });
    ++running;
    return true;
  };
  begin_what_may = [&] {
    const std::lock_guard lock(mutex);
    if (no_next) return;
    try {
      while (running < places && begin_one()) {
      }
    } catch (...) {
      no_next = std::current_exception();
    }
  };
  arena.execute([&] {
    begin_what_may();
    group.wait();
    hand_over.end();
  });
  if (no_next) std::rethrow_exception(no_next);
  return broken;
}

}  // namespace weft::tasks
