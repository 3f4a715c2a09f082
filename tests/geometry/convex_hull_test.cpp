#include <catch2/catch.hpp>

#include <random>

#include "geometry/convex_hull.h"

using namespace weft;

TEST_CASE("convex_hull: a square with points in it and on its edges is its four corners") {
  CHECK(convex_hull({{0, 0}, {5, 5}, {10, 0}, {5, 0}, {10, 10}, {0, 10}, {0, 5}, {0, 0}}) == Ring{{0, 0}, {10, 0}, {10, 10}, {0, 10}});
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

TEST_CASE("convex_hull: points on a line have no hull") { CHECK(convex_hull({{0, 0}, {1, 1}, {2, 2}, {1, 1}}).size() < 3); }
