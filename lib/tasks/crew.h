// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
#include <vector>

namespace weft::tasks {

/// A piece whose work has thrown.
struct Broken {
  std::size_t piece = 0;
  std::exception_ptr error;
};

/// Works through a list with several pieces side by side, in one arena: what a piece runs in parallel itself shares the
/// threads with the other pieces, and a thread that finds no piece to begin helps those that are running.
/// @param threads 0: all cores. So many pieces run at once at most
/// @param next    index of a piece that may begin now, or nothing when none may (none is left, or memory is short).
/// Asked at
///                the beginning and after each end, never by two threads at once. Pre: with nothing running it names a
///                piece unless none is left
/// @param work    within it a thread takes up no other piece while it waits
/// @return the pieces whose work has thrown, in the order in which they did: each for itself, and no other piece is
///         touched by it
/// @throws what `next` throws, when all that was begun has ended
[[nodiscard]] std::vector<Broken> run_crew(unsigned threads, const std::function<std::optional<std::size_t>()>& next,
                                           const std::function<void(std::size_t)>& work);

/// Number of threads that `threads` stands for: itself, or all cores; fewer where the system gives fewer.
unsigned thread_count(unsigned threads);

}  // namespace weft::tasks
