// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <functional>
#include <memory>

/// Everything that weft asks of TBB, but for the crew of a batch.
namespace weft::tasks {

/// task(i) for i in [0, count), side by side in any order; returns when all are done, and only then.
/// @throws the error of the lowest index that throws, when all have been tried; Stopped where not all were: a loop that
/// was cut short, by whatever, never looks like one that was not
void for_each_index(std::size_t count, const std::function<void(std::size_t)>& task);

/// What is done with each piece of a row, one step after the other.
struct Steps {
  std::function<void(std::size_t)> begin = [](std::size_t) {};   ///< in index order, one at a time
  std::function<void(std::size_t)> make;                         ///< in any order, side by side
  std::function<void(std::size_t)> take;                         ///< in index order, one at a time
  std::function<void(std::size_t)> finish = [](std::size_t) {};  ///< in any order, side by side
};
/// The steps of i for i in [0, count), several pieces on their way at once. Those of i may use the place i % places of
/// what has so many: i − places is done with it.
/// @throws what a step throws, then no further step is begun; Stopped where it was cut short. Pre: places > 0 unless
/// count is 0
void for_each_in_order(std::size_t count, std::size_t places, const Steps& steps);
/// Places that keep all threads at work: for each one that is worked on and one that waits for its turn.
std::size_t most_in_flight();

/// Work that is done beside one's own.
class Beside {
 public:
  /// Begins it.
  explicit Beside(std::function<void()> work);
  /// Waits: left to itself, what runs would break off in the middle of what it makes. What it throws is lost.
  ~Beside();
  Beside(const Beside&) = delete;
  Beside& operator=(const Beside&) = delete;

  /// @throws what the work has thrown; Stopped where it was not done
  void wait();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Work that is done by the first of several who need its result; the others help with its tasks, then go on.
class Once {
 public:
  Once();
  ~Once();
  Once(const Once&) = delete;
  Once& operator=(const Once&) = delete;

  /// Post: some call of `work` has ended without an error, and is seen. When one throws, who waits tries in its turn.
  /// @throws what its call throws; Stopped where none was made
  void run(const std::function<void()>& work);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// For as long as it lives, no more threads are at work than these; 0: all cores.
class ThreadLimit {
 public:
  explicit ThreadLimit(unsigned threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Runs the work where its tasks have so many threads, also more than there are cores; 0: all cores.
void with_threads(unsigned threads, const std::function<void()>& work);

}  // namespace weft::tasks
