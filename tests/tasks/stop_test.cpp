// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"

#include "tasks/crew.h"
#include "tasks/parallel.h"

#include <atomic>

#include <catch2/catch.hpp>

using namespace weft;

namespace {

/// Stops whoever asks it more often than that.
struct Patience {
  explicit Patience(int times) : left(times), whether([this] { return --left < 0; }) {}
  std::atomic<int> left;
  std::function<bool()> whether;
};
constexpr int all = 1 << 20;

}  // namespace

TEST_CASE("tasks: tasks ask whom those ask who began them", "[tasks][law]") {
  const std::size_t n = 300;
  const auto same = [](std::size_t i) { return i; };
  const auto asked_by = [&](const auto& work) {
    Patience patience(all);
    const StopWhen scope(&patience.whether);
    tasks::with_threads(4, work);
    return all - patience.left;
  };
  const auto asks = [](std::size_t i) { return stop_if_asked(), i; };
  CHECK(asked_by([&] { tasks::for_each_index(n, [](std::size_t) { stop_if_asked(); }); }) == n);
  CHECK(asked_by([&] { tasks::parallel_map(n, same); }) == n);
  CHECK(asked_by([&] { tasks::parallel_map(n, asks); }) == 2 * n);
  CHECK(asked_by([&] { tasks::parallel_in_order(n, same, [](std::size_t, std::size_t) { stop_if_asked(); }); }) ==
        2 * n);
  CHECK(asked_by([&] {
          tasks::parallel_linked(
              n, same, [](std::size_t, std::size_t made) { return made; },
              [](std::size_t, std::size_t made) { return made; });
        }) == 2 * n);
  CHECK(asked_by([&] { tasks::parallel_map(10, [&](std::size_t) { return tasks::parallel_map(10, same).size(); }); }) ==
        110);
  CHECK(asked_by([] { tasks::Beside(stop_if_asked).wait(); }) == 1);
  CHECK(asked_by([] { tasks::Once().run(stop_if_asked); }) == 1);
}

TEST_CASE("tasks: what is told to stop ends with Stopped, whichever way its tasks run", "[tasks]") {
  const std::size_t n = 300;
  const auto same = [](std::size_t i) { return i; };
  for (const int times : {0, 1, 50, 299}) {
    const auto ends = [&](const auto& work) {
      Patience patience(times);
      const StopWhen scope(&patience.whether);
      CHECK_THROWS_AS(work(), Stopped);
      CHECK(patience.left < 0);
    };
    CAPTURE(times);
    ends([&] { tasks::parallel_map(n, same); });
    ends([&] { tasks::parallel_in_order(n, same, [](std::size_t, std::size_t) {}); });
    ends([&] {
      tasks::parallel_linked(
          n, same, [](std::size_t, std::size_t made) { return made; },
          [](std::size_t, std::size_t made) { return made; });
    });
    ends([&] { tasks::with_threads(4, [&] { tasks::parallel_map(n, same); }); });
  }
  CHECK_NOTHROW(stop_if_asked());
}

TEST_CASE("tasks: pieces of a crew that share threads ask each their own", "[tasks][law]") {
  constexpr std::size_t pieces = 24;
  std::vector<std::atomic<int>> asked(pieces);
  std::vector<char> stopped(pieces, 0);
  std::size_t begun = 0;
  const auto broken = tasks::run_crew(
      4, [&]() -> std::optional<std::size_t> { return begun < pieces ? std::optional(begun++) : std::nullopt; },
      [&](std::size_t i) {
        const std::function<bool()> whether = [&, i] { return ++asked[i] > 100 && i % 3 == 0; };
        const StopWhen scope(&whether);
        try {
          tasks::parallel_map(200, [](std::size_t k) { return k; });
        } catch (const Stopped&) {
          stopped[i] = 1;
        }
      });
  for (std::size_t i = 0; i < pieces; ++i) {
    CAPTURE(i);
    CHECK(stopped[i] == (i % 3 == 0));
    CHECK(asked[i] == 200);  // also of a piece that is stopped each task asks, and ends at once
  }
}
