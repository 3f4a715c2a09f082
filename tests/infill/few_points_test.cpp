// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/few_points.h"

#include "geometry/simplify.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace weft;

namespace {

Ring circle(double radius, int points) {
  Ring out;
  for (int k = 0; k < points; ++k) {
    const double a = 2 * std::numbers::pi * k / points;
    out.push_back({rounded(radius * std::cos(a)), rounded(radius * std::sin(a))});
  }
  return out;
}

}  // namespace

TEST_CASE("few points: chords pass an arc on both sides, within the bound", "[infill][law]") {
  for (const double radius : {800.0, 2'000.0, 20'000.0}) {
    constexpr double bound = 15;
    const Ring ring = infill::few_points(circle(radius, 2000), true, bound);
    double least = 1e9, most = -1e9;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i], b = ring[(i + 1) % ring.size()];
      for (int t = 0; t <= 16; ++t) {
        const double r = std::hypot(std::lerp(a.x, b.x, t / 16.0), std::lerp(a.y, b.y, t / 16.0));
        least = std::min(least, r - radius), most = std::max(most, r - radius);
      }
    }
    CAPTURE(radius, ring.size());
    CHECK(least >= -1.5 * bound - 1);  // a micron of rounding
    CHECK(most <= 1.5 * bound + 1);
    CHECK(least < -0.3 * bound);
    CHECK(most > 0.3 * bound);
    // points on the circle itself need √2 times as many
    CHECK(static_cast<double>(ring.size()) <
          0.8 * static_cast<double>(geometry::simplified(circle(radius, 2000), rounded(bound)).size()));
  }
}

TEST_CASE("few points: ends and sharp corners stay where they are", "[infill]") {
  Polyline line;
  for (int k = 0; k <= 100; ++k) line.push_back({100 * k, k % 2 * 3});
  for (int k = 1; k <= 100; ++k) line.push_back({10'000, 100 * k});
  const Polyline few = infill::few_points(line, false, 15);
  REQUIRE(few.size() == 3);
  CHECK(few.front() == line.front());
  CHECK(few.back() == line.back());
  CHECK(distance(few[1], {10'000, 0}) <= 15);
  CHECK(infill::few_points(Polyline{{0, 0}, {5, 5}}, false, 15) == Polyline{{0, 0}, {5, 5}});
  CHECK(infill::few_points(Polyline{}, true, 15).empty());
}

TEST_CASE("few points: a ring gives the same points wherever it begins", "[infill][law]") {
  Ring ring = circle(5'000, 333);
  const Ring few = infill::few_points(ring, true, 15);
  std::rotate(ring.begin(), ring.begin() + 100, ring.end());
  CHECK(infill::few_points(ring, true, 15) == few);
}
