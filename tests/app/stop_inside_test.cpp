// SPDX-License-Identifier: GPL-3.0-or-later
// This program is linked with app/small_memory.cpp: its operator new is where a library is stopped that asks nobody.
#include "core/stop_inside.h"

#include "geometry/boolean.h"
#include "jobs/memory.h"
#include "sanitized.h"

#include <algorithm>
#include <atomic>
#include <ctime>
#include <functional>
#include <memory>
#include <random>
#include <thread>
#include <vector>

#include <catch2/catch.hpp>

using namespace weft;

namespace {

/// So many bars across as many along, 100 µm wide: the square of their number crossings, which one call untangles.
std::vector<Ring> bars(int count) {
  std::vector<Ring> out;
  const Um length = 300 * count;
  for (int i = 0; i < count; ++i) {
    const Um at = 300 * i;
    out.push_back({{at, 0}, {at + 100, 0}, {at + 100, length}, {at, length}});
    out.push_back({{0, at}, {length, at}, {length, at + 100}, {0, at + 100}});
  }
  return out;
}

/// Takes memory in so many small pieces. Whether it got them all.
bool gets(int wanted) {
  try {
    std::vector<std::unique_ptr<int>> held(static_cast<std::size_t>(wanted));
    for (auto& piece : held) piece = std::make_unique<int>(wanted);
    return true;
  } catch (const std::bad_alloc&) {
    return false;
  }
}

/// Corners at random: every edge crosses a third of the others, at all heights.
std::vector<Ring> scribble(int corners) {
  std::mt19937 random(1);
  Ring out;
  for (int i = 0; i < corners; ++i)
    out.push_back({static_cast<Um>(random() % 100'000), static_cast<Um>(random() % 100'000)});
  return {out};
}

/// Of processor time, by this thread: what others do must not matter.
double spent_s() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

TEST_CASE("stop inside: there is no memory for who is to stop, and for everybody else there is", "[app]") {
  if (sanitized) return;
  bool stop = false;
  int asked = 0;
  const std::function<bool()> whether = [&] { return ++asked, stop; };
  const auto inside = [](int wanted) {
    const StopInside here;
    return gets(wanted);
  };
  CHECK(inside(10'000));  // nobody is asked
  const StopWhen stop_when(&whether);
  CHECK(inside(10'000));
  CHECK(asked > 10);
  CHECK(asked < 100);  // now and then, not each time
  asked = 0, stop = true;
  CHECK_FALSE(inside(10'000));
  CHECK(asked == 1);
  CHECK(gets(10'000));  // only where it is said
  CHECK(asked == 1);
  bool again = true, other = false;
  std::atomic<bool> begin = false;
  std::thread beside([&] {
    begin.wait(false);
    other = gets(10'000);
  });
  {
    const StopInside here;
    static_cast<void>(gets(10'000));
    again = gets(1);  // what is tried instead ends as well
    begin = true;
    begin.notify_one();
    beside.join();
  }
  CHECK_FALSE(again);
  CHECK(other);
}

TEST_CASE("stop inside: outlines that cross each other a million times are left when the work is to stop", "[app]") {
  if (sanitized) return;
  const auto rings = bars(1000);
  double due_s = 0, latest_s = 0;
  const std::function<bool()> whether = [&] { return spent_s() > due_s; };
  const StopWhen stop_when(&whether);
  const auto before = jobs::resident_bytes();
  for (const int ms : {20, 50, 100, 150, 200, 250, 300, 350, 400, 450}) {
    due_s = spent_s() + 0.001 * ms;
    CHECK_THROWS_AS(geometry::regions_from_rings(rings, geometry::WindingRule::nonzero), Stopped);
    latest_s = std::max(latest_s, spent_s() - due_s);
  }
  CHECK(latest_s < 1);
  CHECK(jobs::resident_bytes() < before + (std::uint64_t{100} << 20));  // each took 20 MB and more: nothing is lost
}

TEST_CASE("stop inside: who gives back between the pieces he takes is let go on until he only takes", "[app]") {
  if (sanitized) return;
  const std::function<bool()> whether = [] { return true; };
  const StopWhen stop_when(&whether);
  const StopInside here;
  std::unique_ptr<int> held;
  const auto exchange = [&] {
    for (int i = 0; i < 10'000; ++i) held = std::make_unique<int>(i);
  };
  CHECK_NOTHROW(exchange());
  CHECK(*held == 9'999);
  CHECK_FALSE(gets(100));
}

TEST_CASE("stop inside: a sweep that is left anywhere leaves memory as it was", "[app]") {
  if (sanitized) return;
  const auto tangle = scribble(2500);
  double due_s = 0;
  const std::function<bool()> whether = [&] { return spent_s() > due_s; };
  const StopWhen stop_when(&whether);
  int left = 0;
  for (int ms = 4; ms < 300; ms += 7) {
    due_s = spent_s() + 0.001 * ms;
    try {
      static_cast<void>(geometry::regions_from_rings(tangle, geometry::WindingRule::nonzero));
    } catch (const Stopped&) {
      ++left;
    }
    due_s = 1e9;  // what is made after that, in the same memory, is what it would have been
    const auto square = geometry::regions_from_rings(scribble(4), geometry::WindingRule::nonzero);
    static const auto first = square;
    REQUIRE(square == first);
  }
  CHECK(left > 10);
}
