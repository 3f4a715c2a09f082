#pragma once
#include <tbb/parallel_for.h>

#include <exception>
#include <functional>
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

}  // namespace weft::pipeline
