// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/comb.h"

#include "layers.h"

#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::travel;

namespace {

bool inside_of(const Regions& grown, Point p) {
  for (const auto& r : grown) {
    if (side_of(r.outer, p) == Side::outside) continue;
    bool in_hole = false;
    for (const auto& h : r.holes) in_hole = in_hole || side_of(h, p) == Side::inside;
    if (!in_hole) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("travel: a comb knows its parts", "[travel]") {
  const Comb comb(sample::plate());
  CHECK(comb.part_of({1000, 1000}) == 0);
  CHECK(comb.part_of({22000, 25000}) == 1);
  CHECK(comb.part_of({22000, 15000}) == Comb::outside);
  CHECK(comb.part_of({9000, 15000}) == Comb::outside);
  CHECK(comb.part_of({-1000, 15000}) == Comb::outside);
  const Comb from_rings(geometry::rings_of(sample::plate()));
  for (Um x = -500; x < 41000; x += 997)
    for (Um y = -500; y < 31000; y += 1009) CHECK(from_rings.part_of({x, y}) == comb.part_of({x, y}));
}

TEST_CASE("travel: combed ways stay inside and are not much longer than the shortest", "[travel][law]") {
  const auto plate = sample::plate();
  const Comb comb(plate);
  const auto grown = geometry::offset(plate, {.by = 20});
  std::mt19937 random(3);
  int found = 0, tried = 0;
  for (int i = 0; i < 2000; ++i) {
    const Point p{static_cast<Um>(random() % 40000), static_cast<Um>(random() % 30000)};
    const Point q{static_cast<Um>(random() % 40000), static_cast<Um>(random() % 30000)};
    if (comb.part_of(p) == Comb::outside || comb.part_of(p) != comb.part_of(q)) continue;
    ++tried;
    const auto way = comb.way(p, q);
    if (!way) continue;
    ++found;
    CHECK(way->back() == q);
    Point at = p;
    double length = 0;
    for (const Point next : *way) {
      for (int k = 0; k <= 50; ++k) CHECK(inside_of(grown, lerp(at, next, k / 50.0)));
      length += distance(at, next);
      at = next;
    }
    CHECK(length < 90000);
  }
  CHECK(tried > 1000);
  CHECK(found == tried);
}

TEST_CASE("travel: round a bay the way bends at its two corners", "[travel]") {
  const Comb comb(sample::plate());
  const auto way = comb.way({19000, 29000}, {26000, 29000});
  REQUIRE(way);
  REQUIRE(way->size() == 3);
  CHECK((*way)[0] == Point{20000, 12000});
  CHECK((*way)[1] == Point{25000, 12000});
}

TEST_CASE("travel: points on the boundary see each other along it", "[travel]") {
  const Comb comb(sample::plate());
  CHECK(comb.sees({0, 0}, {40000, 0}));
  CHECK(comb.sees({20000, 30000}, {20000, 12000}));
  CHECK_FALSE(comb.sees({20000, 30000}, {25000, 30000}));
  CHECK_FALSE(comb.sees({19000, 29000}, {26000, 29000}));
  CHECK(comb.part_of({0, 15000}) == 0);
}
