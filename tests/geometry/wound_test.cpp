// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/wound.h"

#include "geometry/boolean.h"
#include "geometry/clipper_door.h"
#include "geometry/simplify.h"

#include <cmath>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::geometry;

namespace {

/// What following makes of rings; nothing where it leaves them to a sweep.
std::optional<Regions> followed(const std::vector<Ring>& rings, WindingRule rule = WindingRule::positive) {
  return wound(rings, rule, {});
}
/// What a sweep makes of them.
Regions swept(const std::vector<Ring>& rings, WindingRule rule = WindingRule::positive) {
  clipper::FineRings fine;
  for (const Ring& ring : rings) {
    fine.emplace_back();
    for (const Point p : ring)
      fine.back().push_back({std::int64_t{p.x} * clipper::steps, std::int64_t{p.y} * clipper::steps});
  }
  return clipper::run(clipper::Operation::unite, rule, fine, {}, {});
}

Ring ellipse(Point centre, double across, double up, int corners) {
  Ring out;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    out.push_back({centre.x + rounded(across * std::cos(angle)), centre.y + rounded(up * std::sin(angle))});
  }
  return out;
}

}  // namespace

TEST_CASE("geometry: two discs that overlap are followed into one outline") {
  const auto regions = followed({ellipse({0, 0}, 5003, 5003, 41), ellipse({6001, 107}, 5003, 5003, 37)});
  REQUIRE(regions);
  REQUIRE(regions->size() == 1);
  CHECK(regions->front().holes.empty());
  CHECK(box_of(*regions).size().x == Approx(16000).margin(60));
}

TEST_CASE("geometry: a ring of discs is followed into an outline with a hole") {
  std::vector<Ring> discs;
  for (int i = 0; i < 8; ++i)
    discs.push_back(
        ellipse({rounded(10007 * std::cos(i * 0.785)), rounded(10007 * std::sin(i * 0.785))}, 5001, 4999, 31));
  const auto regions = followed(discs);
  REQUIRE(regions);
  REQUIRE(regions->size() == 1);
  CHECK(regions->front().holes.size() == 1);
}

TEST_CASE("geometry: a loop that winds the other way is nothing, and takes from what it lies in") {
  const Ring eight{{0, 0}, {10000, 10013}, {10000, 0}, {0, 9987}};  // the left half runs clockwise
  const auto half = followed({eight});
  REQUIRE(half);
  CHECK(area_mm2(*half) == Approx(25).epsilon(0.01));
  CHECK_FALSE(followed({eight}, WindingRule::nonzero));
  const auto both = followed({eight, {{-1000, -1000}, {3001, -1000}, {3001, 11000}, {-1000, 11000}}});
  REQUIRE(both);
  const std::vector<Ring> rings{eight, {{-1000, -1000}, {3001, -1000}, {3001, 11000}, {-1000, 11000}}};
  CHECK(area_mm2(*both) == Approx(area_mm2(swept(rings))).epsilon(1e-4));
}

TEST_CASE("geometry: rings at random are followed to what a sweep makes of them", "[law]") {
  std::mt19937 random(7);
  int done = 0;
  for (int round = 0; round < 400; ++round) {
    std::vector<Ring> rings;
    const auto many = 1 + random() % 4;
    for (unsigned r = 0; r < many; ++r) {
      Ring ring;
      const auto corners = 3 + random() % 12;
      for (unsigned i = 0; i < corners; ++i)
        ring.push_back({static_cast<Um>(random() % 20000), static_cast<Um>(random() % 20000)});
      drop_collinear(ring);
      if (!ring.empty()) rings.push_back(ring);
    }
    const auto mine = followed(rings);
    if (!mine) continue;
    ++done;
    const Regions all = swept(rings);
    CHECK(area_mm2(exclusive_or(*mine, all)) < 0.005 * (1 + area_mm2(all)));
    CHECK(area_mm2(*mine) == Approx(area_mm2(all)).margin(0.02));
  }
  CHECK(done > 300);
}

TEST_CASE("geometry: discs at random are united to what a sweep makes of them, by either rule", "[law]") {
  std::mt19937 random(11);
  const auto any = [&](Um most) { return static_cast<Um>(random() % static_cast<unsigned>(most)); };
  int done = 0;
  for (int round = 0; round < 200; ++round) {
    std::vector<Ring> discs;
    for (int i = 2 + any(10); i > 0; --i) {
      discs.push_back(ellipse({any(20000), any(20000)}, 1000 + any(5000), 1000 + any(5000), 5 + any(40)));
      drop_collinear(discs.back());
    }
    for (const auto rule : {WindingRule::positive, WindingRule::nonzero}) {
      const auto mine = followed(discs, rule);
      if (!mine) continue;
      ++done;
      CHECK(area_mm2(exclusive_or(*mine, swept(discs, rule))) < 0.01);  // as much as whole microns may change
    }
  }
  CHECK(done > 300);
}

TEST_CASE("geometry: rings that touch are left to a sweep") {
  const Ring left{{0, 0}, {4000, 0}, {4000, 4000}, {0, 4000}},
      right{{4000, 1000}, {8000, 1000}, {8000, 3000}, {4000, 3000}};
  CHECK_FALSE(followed({left, right}));
}
