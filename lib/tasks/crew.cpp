#include "tasks/crew.h"

#include "tasks/hand_over.h"

#include <mutex>

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

namespace weft::tasks {

unsigned thread_count(unsigned threads) {
  return threads != 0 ? threads : static_cast<unsigned>(tbb::info::default_concurrency());
}

void run_crew(unsigned threads, const std::function<std::optional<std::size_t>()>& next,
              const std::function<void(std::size_t)>& work) {
  const unsigned places = thread_count(threads);
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, places);
  tbb::task_arena arena(static_cast<int>(places));
  tbb::task_group group;
  HandOver hand_over;
  std::mutex mutex;
  unsigned running = 0;

  std::function<void()> begin_what_may;
  const auto piece = [&](std::size_t index) {
    // Isolated, or a thread that waits for the last layer of one piece would begin another on top of it.
    tbb::this_task_arena::isolate([&] { work(index); });
    {
      const std::lock_guard lock(mutex);
      --running;
    }
    begin_what_may();
  };
  begin_what_may = [&] {
    const std::lock_guard lock(mutex);
    while (running < places) {
      const auto index = next();
      if (!index) return;
      ++running;
      hand_over.begin();
      group.run([&, i = *index] {
        const HandOver::Task handed(hand_over);
        piece(i);
      });
    }
  };
  arena.execute([&] {
    begin_what_may();
    group.wait();
    hand_over.end();
  });
}

}  // namespace weft::tasks
