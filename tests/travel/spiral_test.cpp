// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/spiral.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace weft;
using travel::Spiral;

namespace {

std::vector<Junction> ring(double radius, int corners, double turned = 0) {
  std::vector<Junction> out;
  for (int i = 0; i < corners; ++i) {
    const double a = turned + 2 * std::numbers::pi * i / corners;
    out.push_back({{rounded(radius * std::cos(a)), rounded(radius * std::sin(a))}, 450, 1.F});
  }
  return out;
}

double length_um(const Extrude& bead) {
  double um = 0;
  for (std::size_t i = 1; i < bead.path.size(); ++i) um += distance(bead.path[i - 1].at, bead.path[i].at);
  return um;
}

}  // namespace

TEST_CASE("spiral: turns follow each other without a gap in x, y or z, and rise evenly") {
  const bool smooth = GENERATE(true, false);
  const int corners = GENERATE(4, 60);
  Spiral spiral({.smooth = smooth});
  constexpr int turns = 12;
  constexpr Um height = 200;
  std::optional<Point3> end;
  for (int i = 0; i < turns; ++i) {
    auto loop = ring(10'000 + 150.0 * i, corners, 0.05 * i);
    if (i % 2 == 1) std::reverse(loop.begin(), loop.end());
    const auto out =
        spiral.turn(loop, height, {i == 0, i + 1 == turns}, i == 0 ? std::optional(Point{9'000, 0}) : std::nullopt);
    REQUIRE(out.size() == (i + 1 == turns ? 2U : 1U));
    const Um z = (i + 1) * height;
    for (const Extrude& turn : out) {
      REQUIRE(turn.below.size() == turn.path.size());
      if (end) CHECK(place_of(turn, 0, z) == *end);
      end = place_of(turn, turn.path.size() - 1, z);
    }
    const Extrude& turn = out.front();
    CHECK(turn.below.front() == height);
    CHECK(turn.below.back() == 0);
    const double whole = length_um(turn);
    double along = 0;
    for (std::size_t k = 1; k < turn.path.size(); ++k) {
      along += distance(turn.path[k - 1].at, turn.path[k].at);
      CHECK(turn.below[k] <= turn.below[k - 1]);
      // As the way goes, to a twentieth of the height: turns are measured on the loop, not where they pass over.
      CHECK(turn.below[k] == Approx(height * (1 - along / whole)).margin(height / 20.0));
    }
  }
}

TEST_CASE("spiral: passing over, a turn lies between two loops, else it keeps to its own") {
  for (const bool smooth : {true, false}) {
    Spiral spiral({.smooth = smooth});
    spiral.turn(ring(10'000, 200), 200, {true, false}, Point{10'000, 0});
    const auto turn = spiral.turn(ring(10'400, 200), 200, {}, std::nullopt).front();
    double along = 0;
    const double whole = length_um(turn);
    for (std::size_t k = 0; k < turn.path.size(); ++k) {
      if (k > 0) along += distance(turn.path[k - 1].at, turn.path[k].at);
      const double radius = std::hypot(turn.path[k].at.x, turn.path[k].at.y);
      const double expected = smooth ? 10'000 + 400 * along / whole : 10'400;
      if (k > 1) CHECK(radius == Approx(expected).margin(15));  // chords of rings, and the way's length
    }
  }
}

TEST_CASE("spiral: the first turn grows from nothing, the one after the last falls to it, and the rest is whole") {
  Spiral spiral({});
  const auto first = spiral.turn(ring(10'000, 4), 200, {true, false}, Point{10'000, 0}).front();
  const auto next = spiral.turn(ring(10'000, 4), 200, {}, std::nullopt).front();
  const auto last = spiral.turn(ring(10'000, 4), 200, {false, true}, std::nullopt);
  const auto mean_flow = [](const Extrude& bead) {
    double sum = 0;
    for (std::size_t i = 1; i < bead.path.size(); ++i)
      sum += distance(bead.path[i - 1].at, bead.path[i].at) *
             static_cast<double>(bead.path[i - 1].flow + bead.path[i].flow) / 2;
    return sum / length_um(bead);
  };
  CHECK(mean_flow(first) == Approx(0.5).margin(0.01));
  CHECK(static_cast<double>(first.path.front().flow) == Approx(0).margin(1e-6));
  CHECK(static_cast<double>(first.path.back().flow) == Approx(1));
  CHECK(mean_flow(next) == Approx(1));
  REQUIRE(last.size() == 2);
  CHECK(mean_flow(last[0]) == Approx(1));
  CHECK(mean_flow(last[1]) == Approx(0.5).margin(0.01));
  for (const Um below : last[1].below) CHECK(below == 0);
}
