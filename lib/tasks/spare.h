// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <atomic>
#include <cstddef>
#include <functional>
#include <utility>

namespace weft::tasks {

/// Work that nobody waits for yet: threads take it up while there is nothing else for them to do. A row of few tasks,
/// of which one may take as long as all others together, so keeps all threads at work.
class Spare {
 public:
  /// No work: its loops are those of tasks.h.
  Spare() = default;
  /// @param work  of a piece, in any order and side by side. What throws is left undone, and tells nobody: who needs
  ///              the piece has to do it anyway where no thread came to it
  Spare(std::size_t count, std::function<void(std::size_t)> work) : count_(count), work_(std::move(work)) {}
  Spare(const Spare&) = delete;
  Spare& operator=(const Spare&) = delete;

  /// task(i) for i in [0, count), begun in that order; threads that find none left take pieces of the spare work until
  /// the last task has ended. Errors as of tasks::for_each_index.
  void for_each_index(std::size_t count, const std::function<void(std::size_t)>& task);
  /// The same of one task.
  void beside(const std::function<void()>& task) {
    for_each_index(1, [&](std::size_t) { task(); });
  }

 private:
  /// @return whether there was a piece left
  bool do_one();

  std::size_t count_ = 0;
  std::function<void(std::size_t)> work_;
  std::atomic<std::size_t> next_ = 0;
};

}  // namespace weft::tasks
