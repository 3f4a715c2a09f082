// SPDX-License-Identifier: GPL-3.0-or-later
#include "tasks/spare.h"

#include "core/stop.h"
#include "tasks/tasks.h"

#include <exception>
#include <utility>
#include <vector>

namespace weft::tasks {
namespace {

/// A loop that a thread is in. Where a task waits for loops of its own, its thread may be handed another turn of the
/// loop around it, which would keep it from what it waits for.
class In {
 public:
  explicit In(const void* loop) : loop_(loop), around_(std::exchange(innermost, this)) {}
  ~In() { innermost = around_; }
  In(const In&) = delete;
  In& operator=(const In&) = delete;

  static bool is(const void* loop) {
    const In* in = innermost;
    while (in != nullptr && in->loop_ != loop) in = in->around_;
    return in != nullptr;
  }

 private:
  static thread_local const In* innermost;
  const void* loop_;
  const In* around_;
};
thread_local const In* In::innermost = nullptr;

}  // namespace

bool Spare::do_one() {
  const std::size_t piece = next_ < count_ ? next_++ : count_;
  if (piece >= count_) return false;
  try {
    work_(piece);
  } catch (...) {  // whoever needs the piece finds out
  }
  return true;
}

void Spare::for_each_index(std::size_t count, const std::function<void(std::size_t)>& task) {
  if (next_ >= count_) return tasks::for_each_index(count, task);
  std::vector<std::exception_ptr> failed(count);
  std::atomic<std::size_t> begun = 0, ended = 0;
  const auto turn = [&](std::size_t) {
    if (In::is(&begun)) return;
    const In in(&begun);
    for (std::size_t i = begun++; i < count; i = begun++) {
      try {
        stop_if_asked();
        task(i);
      } catch (...) {
        failed[i] = std::current_exception();
      }
      ++ended;
    }
    while (ended < count && do_one()) {
    }
  };
  tasks::for_each_index(most_in_flight(), turn);
  for (const auto& error : failed)
    if (error) std::rethrow_exception(error);
  if (ended != count) throw Stopped{};
}

}  // namespace weft::tasks
