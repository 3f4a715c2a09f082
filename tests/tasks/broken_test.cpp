// SPDX-License-Identifier: GPL-3.0-or-later
#include "tasks/crew.h"
#include "tasks/parallel.h"

#include <atomic>
#include <new>
#include <numeric>
#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

using namespace weft;

namespace {

/// 0 + … + (n − 1), by loops of every kind that stand in each other. What is cut short anywhere makes it less.
std::size_t sum_by_loops(std::size_t n) {
  std::size_t in_order = 0;
  tasks::parallel_in_order(
      n,
      [](std::size_t i) {
        const auto ones = tasks::parallel_map(i, [](std::size_t) { return std::size_t{1}; });
        return std::accumulate(ones.begin(), ones.end(), std::size_t{0});
      },
      [&](std::size_t, std::size_t each) { in_order += each; });
  std::atomic<std::size_t> any_order = 0, beside = 0;
  tasks::for_each_index(n, [&](std::size_t i) { any_order += i; });
  tasks::Beside work([&] { tasks::for_each_index(n, [&](std::size_t i) { beside += i; }); });
  work.wait();
  std::size_t once = 0;
  tasks::Once().run([&] { once = any_order; });
  const auto linked = tasks::parallel_linked(
      n, [](std::size_t i) { return i; }, [](std::size_t, std::size_t i) { return i; },
      [](std::size_t, std::size_t i) { return i; });
  const bool agree = in_order == any_order && in_order == beside && in_order == once &&
                     in_order == std::accumulate(linked.begin(), linked.end(), std::size_t{0});
  return agree ? in_order : 0;
}

}  // namespace

TEST_CASE("tasks: a piece of a crew that throws, whatever it throws, touches no other piece", "[tasks][law]") {
  constexpr std::size_t pieces = 40, n = 60;
  for (int again = 0; again < 10; ++again) {
    std::vector<std::size_t> sums(pieces, 0);
    std::size_t begun = 0;
    const auto broken = tasks::run_crew(
        4, [&]() -> std::optional<std::size_t> { return begun < pieces ? std::optional(begun++) : std::nullopt; },
        [&](std::size_t i) {
          if (i % 10 == 3) throw std::runtime_error(std::to_string(i));
          if (i % 10 == 6) tasks::parallel_map(n, [](std::size_t k) { return k == 7 ? throw std::bad_alloc() : k; });
          if (i % 10 == 9) throw i;
          sums[i] = sum_by_loops(n);
        });
    CHECK(broken.size() == 12);
    for (const auto& piece : broken) CHECK((piece.piece % 10 == 3 || piece.piece % 10 == 6 || piece.piece % 10 == 9));
    for (std::size_t i = 0; i < pieces; ++i) {
      CAPTURE(i);
      CHECK(sums[i] == (i % 10 == 3 || i % 10 == 6 || i % 10 == 9 ? 0 : n * (n - 1) / 2));
    }
  }
}

TEST_CASE("tasks: a crew ends what it has begun before it tells that no further piece could be named", "[tasks]") {
  std::atomic<int> ended = 0;
  std::size_t begun = 0;
  const auto work = [&] {
    return tasks::run_crew(
        3, [&]() -> std::optional<std::size_t> { return begun < 5 ? begun++ : throw std::bad_alloc(); },
        [&](std::size_t) { sum_by_loops(30), ++ended; });
  };
  CHECK_THROWS_AS(work(), std::bad_alloc);
  CHECK(ended == 5);
}

TEST_CASE("tasks: any step of a row may throw, and what is told is the error, not a shorter row", "[tasks]") {
  const auto nothing = [](std::size_t) {};
  const auto throws_at = [](std::size_t at) {
    return [at](std::size_t i) {
      if (i == at) throw std::runtime_error("here");
    };
  };
  for (const std::size_t at : {0U, 5U, 99U}) {
    CAPTURE(at);
    CHECK_THROWS_AS(tasks::for_each_index(100, throws_at(at)), std::runtime_error);
    CHECK_THROWS_AS(tasks::for_each_in_order(100, 8, {.begin = throws_at(at), .make = nothing, .take = nothing}),
                    std::runtime_error);
    CHECK_THROWS_AS(tasks::for_each_in_order(100, 8, {.make = throws_at(at), .take = nothing}), std::runtime_error);
    CHECK_THROWS_AS(tasks::for_each_in_order(100, 8, {.make = nothing, .take = throws_at(at)}), std::runtime_error);
    CHECK_THROWS_AS(tasks::for_each_in_order(100, 8, {.make = nothing, .take = nothing, .finish = throws_at(at)}),
                    std::runtime_error);
  }
}

TEST_CASE("tasks: of results of which one was not made nothing can be taken", "[tasks]") {
  std::vector<std::optional<int>> results{1, std::nullopt, 3};
  CHECK_THROWS_AS(tasks::taken_out(results), Stopped);
  CHECK_THROWS_AS(tasks::taken(results[1]), Stopped);
  results = {1, 2, 3};
  CHECK(tasks::taken_out(results) == std::vector{1, 2, 3});
}
