// SPDX-License-Identifier: GPL-3.0-or-later
#include "tasks/parallel.h"

#include <numeric>
#include <stdexcept>
#include <string>

#include <catch2/catch.hpp>

using namespace weft::tasks;

TEST_CASE("tasks: links are made in index order, whatever the threads, and results come in it") {
  for (const unsigned threads : {1u, 2u, 8u}) {
    const ThreadLimit limit(threads);
    std::vector<std::size_t> linked;
    std::size_t sum = 0;
    const auto out = parallel_linked(
        500, [](std::size_t i) { return std::string(i, 'x'); },
        [&](std::size_t i, std::string text) {
          linked.push_back(i);
          return sum += text.size();
        },
        [](std::size_t i, std::size_t before) { return std::pair(i, before); });
    REQUIRE(out.size() == 500);
    REQUIRE(linked.size() == 500);
    for (std::size_t i = 0; i < 500; ++i) {
      CHECK(linked[i] == i);
      CHECK(out[i] == std::pair(i, i * (i + 1) / 2));
    }
  }
  std::string all;
  parallel_in_order(
      26, [](std::size_t i) { return static_cast<char>('a' + i); }, [&](std::size_t, char c) { all += c; });
  CHECK(all == "abcdefghijklmnopqrstuvwxyz");
  parallel_in_order(
      0, [](std::size_t) { return 0; }, [&](std::size_t, int) { FAIL(); });
}

TEST_CASE("tasks: of several errors that of the lowest index is told, in whichever step it was") {
  const auto error_of = [](std::size_t in_f, std::size_t in_link, std::size_t in_g) {
    const auto maybe = [](std::size_t i, std::size_t at, const char* where) {
      if (i == at) throw std::runtime_error(where + std::to_string(i));
      return i;
    };
    try {
      parallel_linked(
          200, [&](std::size_t i) { return maybe(i, in_f, "f"); },
          [&](std::size_t i, std::size_t) { return maybe(i, in_link, "link"); },
          [&](std::size_t i, std::size_t) { return maybe(i, in_g, "g"); });
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  for (int round = 0; round < 20; ++round) {
    CHECK(error_of(7, 8, 9) == "f7");
    CHECK(error_of(9, 7, 8) == "link7");
    CHECK(error_of(8, 9, 7) == "g7");
    CHECK(error_of(150, 900, 3) == "g3");
    CHECK(error_of(900, 900, 900) == "none");
  }
}
