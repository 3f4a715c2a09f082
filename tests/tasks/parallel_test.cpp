// SPDX-License-Identifier: GPL-3.0-or-later
#include "tasks/parallel.h"

#include "tasks/crew.h"

#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

using namespace weft;

TEST_CASE("tasks: what tasks make comes in index order, and is seen by who waits for it", "[tasks][law]") {
  const std::vector<int> read = [] {
    std::vector<int> v(1000);
    for (std::size_t i = 0; i < v.size(); ++i) v[i] = static_cast<int>(i);
    return v;
  }();
  for (int again = 0; again < 20; ++again) {
    const auto texts = tasks::parallel_map(read.size(), [&](std::size_t i) {
      const auto inner = tasks::parallel_map(3, [&](std::size_t k) { return read[i] + static_cast<int>(k); });
      return std::to_string(inner[0] + inner[1] + inner[2]);
    });
    REQUIRE(texts.size() == read.size());
    for (std::size_t i = 0; i < texts.size(); ++i) CHECK(texts[i] == std::to_string(3 * read[i] + 3));
  }
  CHECK(tasks::parallel_map(0, [](std::size_t i) { return i; }).empty());
}

TEST_CASE("tasks: of several errors that of the lowest index is told", "[tasks][law]") {
  for (int again = 0; again < 50; ++again) {
    std::string told;
    try {
      tasks::parallel_map(200, [](std::size_t i) {
        if (i % 7 == 5) throw std::runtime_error(std::to_string(i));
        return i;
      });
    } catch (const std::runtime_error& error) {
      told = error.what();
    }
    CHECK(told == "5");
  }
}

TEST_CASE("tasks: a crew works through its list once, each piece with tasks of its own", "[tasks][law]") {
  for (const unsigned threads : {1U, 2U, 5U}) {
    std::size_t begun = 0;
    std::vector<std::size_t> sums(40, 0);
    const auto broken = tasks::run_crew(
        threads,
        [&]() -> std::optional<std::size_t> {
          if (begun == sums.size()) return std::nullopt;
          return begun++;
        },
        [&](std::size_t i) {
          for (const auto part : tasks::parallel_map(10, [&](std::size_t k) { return i + k; })) sums[i] += part;
        });
    CHECK(broken.empty());
    for (std::size_t i = 0; i < sums.size(); ++i) CHECK(sums[i] == 10 * i + 45);
  }
}

TEST_CASE("tasks: what tasks make is taken in index order, and after an error nothing more", "[tasks][law]") {
  for (const std::size_t count : {std::size_t{0}, std::size_t{1}, std::size_t{3}, std::size_t{500}}) {
    std::vector<std::size_t> taken;
    tasks::parallel_in_order(
        count, [](std::size_t i) { return std::vector<std::size_t>(1 + i % 5, i); },
        [&](std::size_t i, const std::vector<std::size_t>& made) {
          CHECK(made == std::vector<std::size_t>(1 + i % 5, i));
          taken.push_back(i);
        });
    REQUIRE(taken.size() == count);
    for (std::size_t i = 0; i < count; ++i) CHECK(taken[i] == i);
  }
  std::size_t taken = 0;
  const auto make = [](std::size_t i) { return i % 50 == 49 ? throw std::runtime_error(std::to_string(i)) : i; };
  CHECK_THROWS_WITH(tasks::parallel_in_order(500, make, [&](std::size_t, std::size_t) { ++taken; }), "49");
  CHECK(taken == 49);
}
