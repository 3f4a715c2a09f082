// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/beside.h"

#include "areas.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;
using infill::Beside;

TEST_CASE("beside: a way keeps its distance from the edge, past a crack in it", "[infill]") {
  // a square with a crack in its lower side, as narrow as nothing
  const Region region{{{0, 0}, {9'990, 0}, {10'000, 3'000}, {10'010, 0}, {20'000, 0}, {20'000, 20'000}, {0, 20'000}},
                      {}};
  const Beside beside(region, 200);
  const auto from = beside.met_by({{5'000, 0}, {5'000, 10'000}}), to = beside.met_by({{15'000, 0}, {15'000, 10'000}});
  REQUIRE(from);
  REQUIRE(to);
  CHECK(from->way_um == Approx(200).margin(1));
  const auto way = beside.way(*from, *to, 100'000);
  REQUIRE(way);
  CHECK(way->front() == Point{5'000, 200});
  CHECK(way->back() == Point{15'000, 200});
  CHECK(length_of(*way) == Approx(16'000).margin(300));
  CHECK_FALSE(beside.way(*from, *to, 10'000));
  // the other way round is the rest of the ring
  const auto back = beside.way(*to, *from, 100'000);
  REQUIRE(back);
  CHECK(length_of(*back) > 50'000);
}

TEST_CASE("beside: a line that never comes so far from the edge meets nothing", "[infill]") {
  const Beside beside(rectangle(0, 0, 300, 20'000), 200);
  CHECK_FALSE(beside.met_by({{0, 5'000}, {300, 5'000}}));
}
