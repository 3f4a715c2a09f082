// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/convex.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "rectangle.h"

#include <cmath>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

namespace {

Ring round_ring(int corners, double radius_x, double radius_y) {
  Ring out;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * 3.14159265358979 * i / corners + 0.1;
    out.push_back(
        {static_cast<Um>(radius_x * std::cos(angle)) + 12345, static_cast<Um>(radius_y * std::sin(angle)) - 777});
  }
  return out;
}

}  // namespace

TEST_CASE("geometry: what runs round something convex runs once, counter-clockwise, and turns to the left only") {
  CHECK(geometry::runs_round_convex({{0, 0}, {10, 0}, {10, 10}, {0, 10}}));
  CHECK(geometry::runs_round_convex({{0, 0}, {5, 0}, {10, 0}, {10, 10}}));
  for (const int corners : {3, 4, 5, 18, 72}) CHECK(geometry::runs_round_convex(round_ring(corners, 5000, 3000)));
  CHECK_FALSE(geometry::runs_round_convex({{0, 0}, {0, 10}, {10, 10}, {10, 0}}));
  CHECK_FALSE(geometry::runs_round_convex({{0, 0}, {10, 0}, {3, 3}, {0, 10}}));
  CHECK_FALSE(geometry::runs_round_convex({{0, 0}, {10, 0}, {5, 0}}));
  CHECK_FALSE(geometry::runs_round_convex({{0, 0}, {10, 0}, {10, 0}, {10, 10}}));
  CHECK_FALSE(geometry::runs_round_convex({{0, 0}, {10, 0}, {10, 10}, {0, 10}, {0, 0}, {10, 0}, {10, 10}, {0, 10}}));
  Ring star;  // turns to the left only, twice around
  for (const int corner : {0, 2, 4, 1, 3}) star.push_back(round_ring(5, 5000, 5000)[static_cast<std::size_t>(corner)]);
  CHECK_FALSE(geometry::runs_round_convex(star));
  CHECK_FALSE(geometry::runs_round_convex({{0, 0}, {10, 0}}));
}

TEST_CASE("geometry: a convex ring is drawn in as an offset draws it in") {
  for (const int corners : {3, 4, 5, 18, 72})
    for (const double radius : {500.0, 1000.0, 7000.0})
      for (const Um by : {50, 200}) {
        const Ring ring = round_ring(corners, radius, 1.3 * radius);
        const auto fast = geometry::inset_of_convex(ring, by);
        INFO(corners << " corners, radius " << radius << ", by " << by);
        REQUIRE(fast);
        const Regions exact = geometry::offset({{ring, {}}}, {.by = -by});
        CHECK(area_mm2(geometry::exclusive_or({{*fast, {}}}, exact)) < 1e-3 * perimeter_of(ring) / 1000);
      }
}

TEST_CASE("geometry: what is not convex, or too narrow, is left to the offset") {
  CHECK_FALSE(geometry::inset_of_convex({{0, 0}, {1000, 0}, {500, 100}, {1000, 1000}, {0, 1000}}, 10));
  CHECK_FALSE(geometry::inset_of_convex(rectangle(0, 0, 300, 3000).outer, 160));
  CHECK_FALSE(geometry::inset_of_convex({{0, 0}, {0, 1000}, {1000, 1000}, {1000, 0}}, 10));  // clockwise
  CHECK_FALSE(geometry::inset_of_convex({{0, 0}, {500, 0}, {1000, 0}, {1000, 1000}, {0, 1000}}, 10));
  Ring twice;  // a star of five rays turns left at every corner
  for (int i = 0; i < 5; ++i)
    twice.push_back({static_cast<Um>(5000 * std::cos(2.5132741 * i)), static_cast<Um>(5000 * std::sin(2.5132741 * i))});
  CHECK_FALSE(geometry::inset_of_convex(twice, 10));
}
