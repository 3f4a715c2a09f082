// SPDX-License-Identifier: GPL-3.0-or-later
#include "tasks/tasks.h"

#include "core/stop.h"
#include "tasks/crew.h"
#include "tasks/hand_over.h"

#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include <tbb/collaborative_call_once.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

namespace weft::tasks {

namespace {

/// What a task has around its work.
class Task {
 public:
  Task(HandOver& hand_over, const std::function<bool()>* whether) : handed_(hand_over), stop_when_(whether) {}

 private:
  HandOver::Task handed_;
  StopWhen stop_when_;
};

/// What becomes of the pieces of a row. TBB sees no error of a piece: one that it sees cancels what runs beside it and
/// below it, whose loops then return early as if they had done all.
class Row {
 public:
  explicit Row(std::size_t count) : count_(count) {}

  /// work() of piece i. An error is kept, that of the lowest index.
  template <class Work>
  void piece(std::size_t i, const Work& work) {
    try {
      work();
    } catch (...) {
      const std::lock_guard lock(mutex_);
      broken_ = true;
      if (!error_ || i < at_) error_ = std::current_exception(), at_ = i;
    }
  }
  /// Has a piece failed?
  bool broken() const { return broken_; }
  /// A piece has been through its last step.
  void done() { ++done_; }

  /// To be called when the loop has returned, and nothing it made may be used before. @throws the error that was kept,
  /// or Stopped where the loop came to no end
  void check() {
    if (error_) std::rethrow_exception(error_);
    if (done_ != count_) throw Stopped{};
  }

 private:
  std::size_t count_;
  std::atomic<std::size_t> done_ = 0;
  std::atomic<bool> broken_ = false;
  std::mutex mutex_;
  std::exception_ptr error_;
  std::size_t at_ = 0;
};

}  // namespace

void for_each_index(std::size_t count, const std::function<void(std::size_t)>& task) {
  const auto* whether = StopWhen::current();
  Row row(count);
  tbb::task_group_context context(tbb::task_group_context::isolated);  // not cut short by what is cancelled around it
  HandOver hand_over;
  hand_over.begin();
  const auto run = [&](const tbb::blocked_range<std::size_t>& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Task in_task(hand_over, whether);
      row.piece(i, [&] { task(i); });
      row.done();
    }
  };
  {
    const HandOver::Wait waited(hand_over);
    // One index at a time: tasks are layers, or several, and whoever has the last of them is waited for.
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count), run, tbb::simple_partitioner(), context);
  }
  row.check();
}

void for_each_in_order(std::size_t count, std::size_t places, const Steps& steps) {
  const auto* whether = StopWhen::current();
  Row row(count);
  tbb::task_group_context context(tbb::task_group_context::isolated);  // not cut short by what is cancelled around it
  HandOver hand_over;
  std::vector<Baton> place(places);
  Baton turn_to_begin, turn_to_take;
  std::size_t next = 0;
  const auto in_place = [&row, &hand_over, &place, places, whether](const std::function<void(std::size_t)>& step,
                                                                    std::size_t i) {
    const Task in_task(hand_over, whether);
    place[i % places].take();
    if (!row.broken()) row.piece(i, [&] { step(i); });
    place[i % places].pass();
    return i;
  };
  const auto begun = [&](tbb::flow_control& control) {
    if (next == count || row.broken()) {
      control.stop();
      return count;
    }
    turn_to_begin.take();
    const std::size_t i = in_place(steps.begin, next++);
    turn_to_begin.pass();
    return i;
  };
  const auto made = [&](std::size_t i) { return in_place(steps.make, i); };
  const auto taken = [&](std::size_t i) {
    turn_to_take.take();
    in_place(steps.take, i);
    turn_to_take.pass();
    return i;
  };
  const auto finished = [&](std::size_t i) { return in_place(steps.finish, i); };
  const auto done = [&](std::size_t) { row.done(); };  // in order, so that the next to use the place comes after
  using tbb::filter_mode;
  const auto filters = tbb::make_filter<void, std::size_t>(filter_mode::serial_in_order, begun) &
                       tbb::make_filter<std::size_t, std::size_t>(filter_mode::parallel, made) &
                       tbb::make_filter<std::size_t, std::size_t>(filter_mode::serial_in_order, taken) &
                       tbb::make_filter<std::size_t, std::size_t>(filter_mode::parallel, finished) &
                       tbb::make_filter<std::size_t, void>(filter_mode::serial_in_order, done);
  hand_over.begin();
  if (count > 0) {
    const HandOver::Wait waited(hand_over);
    tbb::parallel_pipeline(places, filters, context);
  }
  row.check();
}
std::size_t most_in_flight() {
  return 2 * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
}

struct Beside::State {
  std::function<void()> work;
  Row row{1};
  tbb::task_group_context context{tbb::task_group_context::isolated};
  tbb::task_group group{context};
  HandOver hand_over;
};
Beside::Beside(std::function<void()> work) : state_(std::make_unique<State>()) {
  State* state = state_.get();
  state->work = std::move(work);
  state->hand_over.begin();
  state->group.run([state, whether = StopWhen::current()] {
    const Task in_task(state->hand_over, whether);
    state->row.piece(0, state->work);
    state->row.done();
  });
}
Beside::~Beside() {
  try {
    wait();
  } catch (...) {  // what ends the job is told already
  }
}
void Beside::wait() {
  {
    const HandOver::Wait waited(state_->hand_over);
    state_->group.wait();
  }
  state_->row.check();
}

struct Once::State {
  tbb::collaborative_once_flag flag;
  std::atomic<bool> done = false;
  HandOver hand_over;
};
Once::Once() : state_(std::make_unique<State>()) {}
Once::~Once() = default;
void Once::run(const std::function<void()>& work) {
  state_->hand_over.begin();
  {
    const HandOver::Wait waited(state_->hand_over);
    tbb::collaborative_call_once(state_->flag, [&, whether = StopWhen::current()] {
      const Task in_task(state_->hand_over, whether);
      work();
      state_->done = true;
    });
  }
  if (!state_->done) throw Stopped{};
}

struct ThreadLimit::State {
  tbb::global_control control;
};
ThreadLimit::ThreadLimit(unsigned threads)
    : state_(new State{{tbb::global_control::max_allowed_parallelism, thread_count(threads)}}) {}
ThreadLimit::~ThreadLimit() = default;

void with_threads(unsigned threads, const std::function<void()>& work) {
  const ThreadLimit limit(threads);
  tbb::task_arena arena(static_cast<int>(thread_count(threads)));
  HandOver hand_over;
  hand_over.begin();
  const HandOver::Wait waited(hand_over);
  arena.execute([&, whether = StopWhen::current()] {
    const Task in_task(hand_over, whether);
    work();
  });
}

}  // namespace weft::tasks
