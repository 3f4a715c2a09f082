// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/simplify.h"

#include "geometry/spatial_index.h"
#include "picture.h"
#include "shapes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::geometry;

namespace {
double distance_to_segment(Point p, Point a, Point b) {
  const double length2 = static_cast<double>(distance2(a, b));
  const double t = length2 == 0 ? 0 : std::clamp(static_cast<double>(dot(p - a, b - a)) / length2, 0.0, 1.0);
  return std::hypot(a.x + t * (b.x - a.x) - p.x, a.y + t * (b.y - a.y) - p.y);
}
}  // namespace

TEST_CASE("geometry: simplifying keeps every dropped point within the bound of its chord", "[law]") {
  shapes::Dice dice(21);
  for (int i = 0; i < 300; ++i) {
    const Um bound = dice.between(1, 60);
    Polyline line{{0, 0}};
    const Um step = dice.between(1, 80);
    for (int k = 0; k < 200; ++k)
      line.push_back(line.back() + Point{dice.between(-step, 2 * step), dice.between(-step, step)});
    const Polyline simple = simplified_line(line, bound);
    REQUIRE(simple.front() == line.front());
    REQUIRE(simple.back() == line.back());
    std::size_t at = 0;  // walk both: each kept point is found again in order, what lies between is near the chord
    for (std::size_t k = 1; k < simple.size(); ++k) {
      std::size_t end = at + 1;
      double worst = 0;
      while (end < line.size() && line[end] != simple[k])
        worst = std::max(worst, distance_to_segment(line[end++], simple[k - 1], simple[k]));
      REQUIRE(end < line.size());
      CHECK(worst <= bound + 1e-6);
      at = end;
    }
  }
}

TEST_CASE("geometry: a fine circle keeps its shape with few points") {
  Ring circle;
  for (int i = 0; i < 3000; ++i)
    circle.push_back({rounded(10000 * std::cos(i * 2 * std::numbers::pi / 3000)),
                      rounded(10000 * std::sin(i * 2 * std::numbers::pi / 3000))});
  const Ring simple = simplified(circle, 12);
  CHECK(simple.size() < 120);
  for (const Point p : simple) CHECK(std::count(circle.begin(), circle.end(), p) > 0);
  CHECK(static_cast<double>(double_area(simple)) == Approx(static_cast<double>(double_area(circle))).epsilon(0.002));
}

TEST_CASE("geometry: a circle of pieces that overlap a little has as few points as one of pieces that meet") {
  const auto at = [](double i) {
    const double angle = i * 2 * std::numbers::pi / 700;
    return Point{rounded(30'000 * std::cos(angle)), rounded(30'000 * std::sin(angle))};
  };
  Ring meeting, overlapping;
  for (int i = 0; i < 700; ++i) {
    meeting.push_back(at(i));
    overlapping.push_back(at(i - 0.01));  // 3 µm back
    overlapping.push_back(at(i + 1));
  }
  CHECK(simplified(overlapping, 13).size() <= simplified(meeting, 13).size() + 10);
}

TEST_CASE("geometry: a ring smaller than the bound does not collapse") {
  const Ring tiny{{0, 0}, {5, 0}, {5, 5}, {2, 6}, {0, 5}};
  CHECK(simplified(tiny, 100) == tiny);
}

TEST_CASE("geometry: collinear points, repeated points and spikes are dropped exactly") {
  Ring ring{{500, 0}, {1000, 0}, {1000, 0}, {2000, 0}, {1000, 0}, {1000, 1000}, {500, 1000}, {0, 1000}, {0, 0}};
  drop_collinear(ring);
  CHECK(ring.size() == 4);
  CHECK(double_area(ring) == 2'000'000);
  Ring flat_ring{{0, 0}, {1000, 0}, {500, 0}};
  drop_collinear(flat_ring);
  CHECK(flat_ring.empty());
  Ring nearly{{0, 0}, {1000000, 1}, {2000000, 3}, {0, 1000}};
  drop_collinear(nearly);
  CHECK(nearly.size() == 4);
  Polyline back_and_forth{{0, 0}, {0, 0}, {500, 0}, {1000, 0}, {200, 0}};
  drop_collinear_of_line(back_and_forth);
  CHECK(back_and_forth == Polyline{{0, 0}, {1000, 0}, {200, 0}});
}

TEST_CASE("geometry: a ring that may lose area has no more corners than the bound asks for") {
  Ring ring;
  for (int i = 0; i < 60; ++i) {
    const double angle = i * std::numbers::pi / 30;
    ring.push_back({rounded(1000 * std::cos(angle)), rounded(1000 * std::sin(angle))});
  }
  const Ring coarse = coarsened(ring, 50);
  CHECK(coarse.size() <= 12);  // chords of 36 degrees are 49 from the arc
  CHECK(simplified(ring, 50).size() > coarse.size());
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    CHECK(std::find(ring.begin(), ring.end(), coarse[i]) != ring.end());
    CHECK(std::hypot(coarse[i].x + coarse[(i + 1) % coarse.size()].x, coarse[i].y + coarse[(i + 1) % coarse.size()].y) /
              2 >
          949);
  }
  const Ring speck{{0, 0}, {30, 0}, {30, 30}, {0, 30}};
  CHECK(coarsened(speck, 50) == speck);
}

TEST_CASE("geometry: a small ring keeps its area to 0.75 % when it is simplified", "[law]") {
  // With the bound alone a pillar of 0.6 mm lost 3.4 %.
  for (const Um radius : {100, 300, 1'000})
    for (const bool hole : {false, true}) {
      Ring ring;
      for (int k = 0; k < 60; ++k) {
        const double a = 2 * std::numbers::pi * k / 60;
        ring.push_back({rounded(radius * std::cos(a)), rounded(radius * std::sin(a))});
      }
      if (hole) std::reverse(ring.begin(), ring.end());
      const Ring simple = simplified(ring, 12);
      CAPTURE(radius, hole, simple.size());
      CHECK(static_cast<double>(double_area(simple)) == Approx(static_cast<double>(double_area(ring))).epsilon(0.0076));
      CHECK(simple.size() < ring.size());
    }
}

TEST_CASE("geometry: simplified regions do not cross where they are narrower than the bound", "[law]") {
  shapes::Dice dice(51);
  for (int round = 0; round < 40; ++round) {
    // Two walls run side by side, 15 µm apart, waving by 30 µm.
    Ring lower{{0, -5000}, {20000, -5000}}, upper;
    for (int i = 40; i >= 0; --i) lower.push_back({i * 500, dice.between(-30, 30)});
    for (int i = 40; i >= 0; --i) upper.push_back(lower[static_cast<std::size_t>(i) + 2] + Point{0, 15});
    std::reverse(upper.begin(), upper.end());
    upper.insert(upper.end(), {{0, 5000}, {20000, 5000}});
    if (double_area(upper) < 0) std::reverse(upper.begin(), upper.end());
    const Regions regions{{lower, {}}, {upper, {}}};
    tests::look_at(regions);
    REQUIRE(SegmentIndex(regions).crossing_pairs().empty());
    CHECK(SegmentIndex(simplified(regions, 40)).crossing_pairs().empty());
  }
}
