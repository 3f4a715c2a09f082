// SPDX-License-Identifier: GPL-3.0-or-later
#include "tasks/spare.h"

#include "tasks/crew.h"
#include "tasks/parallel.h"

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

using namespace weft;

TEST_CASE("tasks: all tasks are done once, and of spare pieces none twice", "[tasks][law]") {
  for (const unsigned threads : {1U, 2U, 5U})
    for (const std::size_t tasks_count : {0UL, 1UL, 3UL, 40UL})
      tasks::with_threads(threads, [&, tasks_count] {
        std::vector<int> pieces(50, 0);
        tasks::Spare spare(pieces.size(), [&](std::size_t i) {
          for (const auto part : tasks::parallel_map(3, [](std::size_t k) { return static_cast<int>(k); }))
            pieces[i] += part;
        });
        for (int again = 0; again < 5; ++again) {
          std::vector<std::size_t> sums(tasks_count, 0);
          spare.for_each_index(sums.size(), [&](std::size_t i) {
            for (const auto part : tasks::parallel_map(10, [&](std::size_t k) { return i + k; })) sums[i] += part;
          });
          for (std::size_t i = 0; i < sums.size(); ++i) CHECK(sums[i] == 10 * i + 45);
        }
        for (const int done : pieces) CHECK((done == 0 || done == 3));
      });
}

TEST_CASE("tasks: while one task runs, who has none takes spare pieces", "[tasks]") {
  if (tasks::thread_count(2) < 2) return;
  tasks::with_threads(2, [] {
    std::atomic<std::size_t> done = 0;
    tasks::Spare spare(4, [&](std::size_t) { ++done; });
    std::size_t seen = 0;
    spare.beside([&] {
      const auto late = std::chrono::steady_clock::now() + std::chrono::minutes(2);  // or it would hang for ever
      while (done < 4 && std::chrono::steady_clock::now() < late) std::this_thread::yield();
      seen = done;
    });
    CHECK(seen == 4);
  });
}

TEST_CASE("tasks: beside spare work the error of the lowest index is told, and none of a spare piece", "[tasks][law]") {
  tasks::with_threads(3, [] {
    for (int again = 0; again < 20; ++again) {
      tasks::Spare spare(1000, [](std::size_t) { throw std::runtime_error("spare"); });
      std::string told;
      try {
        spare.for_each_index(60, [](std::size_t i) {
          if (i % 7 == 5) throw std::runtime_error(std::to_string(i));
        });
      } catch (const std::runtime_error& error) {
        told = error.what();
      }
      CHECK(told == "5");
      CHECK_NOTHROW(spare.for_each_index(3, [](std::size_t) {}));
    }
  });
}
