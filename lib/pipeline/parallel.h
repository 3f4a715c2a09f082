#pragma once
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/task_arena.h>

#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

namespace weft::pipeline {

/// f(i) for i in [0, count), computed in any order, returned in index order. If calls throw, the error of the lowest index
/// is rethrown: the number of threads changes neither the output nor the message.
template <class F>
auto parallel_map(std::size_t count, F f) {
  using Out = std::invoke_result_t<F&, std::size_t>;
  std::vector<std::optional<Out>> slots(count);
  std::vector<std::exception_ptr> failed(count);
  tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
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
    std::size_t index;
    std::optional<Out> out;
    std::exception_ptr failed;
  };
  using Handle = std::shared_ptr<Piece>;
  std::size_t next = 0;
  const auto number = [&](tbb::flow_control& control) -> Handle {
    if (next < count) return std::make_shared<Piece>(Piece{next++, {}, {}});
    control.stop();
    return {};
  };
  const auto make = [&](Handle piece) {
    try {
      piece->out.emplace(f(piece->index));
    } catch (...) {
      piece->failed = std::current_exception();
    }
    return piece;
  };
  const auto hand_over = [&](const Handle& piece) {
    if (piece->failed) std::rethrow_exception(piece->failed);
    take(piece->index, std::move(*piece->out));
  };
  using tbb::filter_mode;
  tbb::parallel_pipeline(4 * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()),
                         tbb::make_filter<void, Handle>(filter_mode::serial_in_order, number) &
                             tbb::make_filter<Handle, Handle>(filter_mode::parallel, make) &
                             tbb::make_filter<Handle, void>(filter_mode::serial_in_order, hand_over));
}

}  // namespace weft::pipeline
