// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/stop.h"
#include "tasks/tasks.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft::tasks {

/// What is there. @throws Stopped where nothing is: it was not made
template <class Out>
Out taken(std::optional<Out>& result) {
  if (!result) throw Stopped{};
  return std::move(*result);
}

/// All results, the only way to them. @throws Stopped when one is missing: there is no shorter list
template <class Out>
std::vector<Out> taken_out(std::vector<std::optional<Out>>& results) {
  std::vector<Out> out;
  out.reserve(results.size());
  for (auto& result : results) out.push_back(taken(result));
  return out;
}

/// f(i) for i in [0, count), computed in any order, returned in index order; before each, as in all that follow, it is
/// asked whether to stop. If calls throw, the error of the lowest index
/// is rethrown: the number of threads changes neither the output nor the message.
template <class F>
auto parallel_map(std::size_t count, F f) {
  using Out = std::invoke_result_t<F&, std::size_t>;
  std::vector<std::optional<Out>> slots(count);
  for_each_index(count, [&](std::size_t i) { stop_if_asked(), slots[i].emplace(f(i)); });
  return taken_out(slots);
}

/// take(i, f(i)) for i in [0, count): f in any order and side by side, take in index order and one at a time. Few
/// results wait for their turn, so that what take has done with need not be there as a whole. Errors as in
/// parallel_map.
template <class F, class Take>
void parallel_in_order(std::size_t count, F f, Take take) {
  using Out = std::invoke_result_t<F&, std::size_t>;
  struct Piece {
    std::optional<Out> out;
    std::exception_ptr failed;
  };
  const std::size_t slots = std::min(count, most_in_flight());
  std::vector<Piece> pieces(slots);
  const auto make = [&](std::size_t i) {
    Piece& piece = pieces[i % slots];
    try {
      stop_if_asked();
      piece.out.emplace(f(i));
    } catch (...) {
      piece.failed = std::current_exception();
    }
  };
  const auto take_out = [&](std::size_t i) {
    Piece& piece = pieces[i % slots];
    if (piece.failed) std::rethrow_exception(piece.failed);
    take(i, taken(piece.out));
    piece.out.reset();
  };
  for_each_in_order(count, slots, {.make = make, .take = take_out});
}

/// g(i, link(i, f(i))) for i in [0, count), returned in index order: f and g in any order and side by side, link in
/// index order and one at a time. Few pieces are on their way at once, so that what a step has used up need not be
/// there as a whole. Errors as in parallel_map.
template <class F, class Link, class G>
auto parallel_linked(std::size_t count, F f, Link link, G g) {
  using Made = std::invoke_result_t<F&, std::size_t>;
  using Linked = std::invoke_result_t<Link&, std::size_t, Made>;
  using Out = std::invoke_result_t<G&, std::size_t, Linked>;
  struct Piece {
    std::optional<Made> made;
    std::optional<Linked> linked;
  };
  const std::size_t slots = std::min(count, most_in_flight());
  std::vector<Piece> pieces(slots);
  std::vector<std::optional<Out>> results(count);
  std::vector<std::exception_ptr> failed(count);
  std::atomic<bool> broken = false;  // a link is missing: nothing after it counts
  const auto guarded = [&](std::size_t i, const auto& step) {
    try {
      step(pieces[i % slots]);
    } catch (...) {
      failed[i] = std::current_exception();
    }
  };
  const auto make = [&](std::size_t i) {
    if (!broken) guarded(i, [&](Piece& piece) { stop_if_asked(), piece.made.emplace(f(i)); });
  };
  const auto take = [&](std::size_t i) {
    if (failed[i]) broken = true;
    if (broken) return;
    guarded(i, [&](Piece& piece) { piece.linked.emplace(link(i, taken(piece.made))); });
    if (failed[i]) broken = true;
  };
  const auto finish = [&](std::size_t i) {
    if (!pieces[i % slots].linked) return;
    guarded(i, [&](Piece& piece) { stop_if_asked(), results[i].emplace(g(i, taken(piece.linked))); });
    pieces[i % slots].linked.reset();
  };
  for_each_in_order(count, slots, {.make = make, .take = take, .finish = finish});
  for (const auto& error : failed)
    if (error) std::rethrow_exception(error);
  return taken_out(results);
}

}  // namespace weft::tasks
