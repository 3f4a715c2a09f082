#pragma once
#include "pipeline/tasks.h"

#include <algorithm>
#include <cstddef>
#include <exception>
#include <functional>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

namespace weft::pipeline {

/// f(i) for i in [0, count), computed in any order, returned in index order. If calls throw, the error of the lowest index
/// is rethrown: the number of threads changes neither the output nor the message.
template <class F>
auto parallel_map(std::size_t count, F f) {
  using Out = std::invoke_result_t<F&, std::size_t>;
  std::vector<std::optional<Out>> slots(count);
  std::vector<std::exception_ptr> failed(count);
  for_each_index(count, [&](std::size_t i) {
    try {
      slots[i].emplace(f(i));
    } catch (...) {
      failed[i] = std::current_exception();
    }
  });
  for (const auto& error : failed)
    if (error) std::rethrow_exception(error);
  std::vector<Out> out;
  out.reserve(count);
  for (auto& slot : slots) out.push_back(std::move(*slot));
  return out;
}

/// take(i, f(i)) for i in [0, count): f in any order and side by side, take in index order and one at a time. Few results
/// wait for their turn, so that what take has done with need not be there as a whole. Errors as in parallel_map.
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
      piece.out.emplace(f(i));
    } catch (...) {
      piece.failed = std::current_exception();
    }
  };
  for_each_in_order(count, slots, make, [&](std::size_t i) {
    Piece& piece = pieces[i % slots];
    if (piece.failed) std::rethrow_exception(piece.failed);
    take(i, std::move(*piece.out));
    piece.out.reset();
  });
}

}  // namespace weft::pipeline
