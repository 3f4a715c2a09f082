// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"

#include <exception>
#include <thread>

#include <catch2/catch.hpp>

using namespace weft;

TEST_CASE("stop: work asks whom the innermost scope names, and nobody without one", "[core]") {
  int outer_asked = 0, inner_asked = 0;
  const std::function<bool()> outer = [&] { return ++outer_asked > 2; }, inner = [&] { return ++inner_asked < 0; };
  CHECK_NOTHROW(stop_if_asked());
  {
    const StopWhen of_outer(&outer);
    CHECK_NOTHROW(stop_if_asked());
    {
      const StopWhen of_inner(&inner);
      for (int i = 0; i < 10; ++i) CHECK_NOTHROW(stop_if_asked());
      const StopWhen nobody(nullptr);
      CHECK_NOTHROW(stop_if_asked());
    }
    CHECK(inner_asked == 10);
    CHECK_NOTHROW(stop_if_asked());
    CHECK_THROWS_AS(stop_if_asked(), Stopped);
    std::thread([] { CHECK_NOTHROW(stop_if_asked()); }).join();  // another thread is not meant
  }
  CHECK_NOTHROW(stop_if_asked());
  CHECK(outer_asked == 3);
}

TEST_CASE("stop: short steps ask at one of so many", "[core]") {
  int asked = 0;
  const std::function<bool()> whether = [&] { return ++asked == 3; };
  const StopWhen scope(&whether);
  StopNowAndThen stop(100);
  int steps = 0;
  const auto work = [&] {
    for (;;) stop.step(), ++steps;
  };
  CHECK_THROWS_AS(work(), Stopped);
  CHECK(steps == 299);
}

TEST_CASE("stop: what ends work is not taken for an exception that a library throws", "[core]") {
  const std::function<bool()> always = [] { return true; };
  const StopWhen scope(&always);
  const auto careful = [] {
    try {
      stop_if_asked();
    } catch (const std::exception&) {
    }
  };
  CHECK_THROWS_AS(careful(), Stopped);
}
