// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/convex_hull.h"

#include <algorithm>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;

TEST_CASE("convex_hull: a square with points in it and on its edges is its four corners") {
  CHECK(convex_hull({}).empty());
  CHECK(convex_hull({{0, 0}, {5, 5}, {10, 0}, {5, 0}, {10, 10}, {0, 10}, {0, 5}, {0, 0}}) ==
        Ring{{0, 0}, {10, 0}, {10, 10}, {0, 10}});
}

TEST_CASE("convex_hull: no point lies outside of it, and it turns left everywhere") {
  std::mt19937 random(7);
  std::uniform_int_distribution<Um> at(-100000, 100000);
  std::vector<Point> points(500);
  for (auto& p : points) p = {at(random), at(random)};
  const auto hull = convex_hull(points);
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Point a = hull[i], b = hull[(i + 1) % hull.size()];
    CHECK(orient(a, b, hull[(i + 2) % hull.size()]) > 0);
    for (const Point p : points) REQUIRE(orient(a, b, p) >= 0);
  }
}

TEST_CASE("convex_hull: on a coarse grid it is strictly convex, and its corners are points of those given", "[law]") {
  std::mt19937 random(8);
  for (int run = 0; run < 200; ++run) {
    std::vector<Point> points;
    const auto span = static_cast<Um>(2 + random() % 3000);
    for (std::size_t i = 0; i < 1 + random() % 300; ++i)
      points.push_back({static_cast<Um>(random()) % span, static_cast<Um>(random()) % span});
    const Ring hull = convex_hull(points);
    for (const Point p : hull) CHECK(std::find(points.begin(), points.end(), p) != points.end());
    if (hull.size() < 3) continue;
    CHECK(double_area(hull) > 0);
    for (std::size_t i = 0; i < hull.size(); ++i)
      CHECK(orient(hull[i], hull[(i + 1) % hull.size()], hull[(i + 2) % hull.size()]) > 0);
    for (const Point p : points) CHECK(side_of(hull, p) != Side::outside);
  }
}

TEST_CASE("convex_hull: points on a line have no hull") {
  CHECK(convex_hull({{0, 0}, {1, 1}, {2, 2}, {1, 1}}).size() < 3);
}
