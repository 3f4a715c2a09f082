// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/touching.h"

#include "geometry/boolean.h"
#include "rectangle.h"

#include <algorithm>
#include <array>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

TEST_CASE("geometry: what overlaps or touches is joined, and covers what a union covers") {
  std::mt19937 random(11);
  for (int n = 0; n < 50; ++n) {
    Regions some;
    for (int i = 0; i < 40; ++i) {
      const Um x = static_cast<Um>(random() % 40) * 500, y = static_cast<Um>(random() % 40) * 500;
      some.push_back(rectangle(x, y, x + 500 + static_cast<Um>(random() % 5) * 500, y + 1000));
    }
    const Regions joined = geometry::joined(some), united = geometry::unite(some);
    CHECK(joined.size() == united.size());
    CHECK(area_mm2(joined) == Approx(area_mm2(united)));
  }
}

TEST_CASE("geometry: many of which some overlap are joined to what a union makes of them") {
  std::mt19937 random(13);
  for (int n = 0; n < 20; ++n) {
    Regions some;
    for (Um i = 0; i < 300; ++i) {  // none has a corner or a line in common with another
      const Um x = static_cast<Um>(random() % 60) * 500 + i, y = static_cast<Um>(random() % 60) * 500 + i;
      some.push_back(rectangle(x, y, x + 500 + static_cast<Um>(random() % 5) * 500, y + 1000));
    }
    const Regions joined = geometry::joined(some), united = geometry::unite(some);
    CHECK(joined.size() == united.size());
    CHECK(area_mm2(joined) == Approx(area_mm2(united)));
  }
}

TEST_CASE("geometry: what lies in the box of a frame is joined with it where it meets its outline or lies within") {
  Region frame = rectangle(0, 0, 30000, 30000);
  Ring hole = rectangle(2000, 2000, 28000, 28000).outer;
  std::reverse(hole.begin(), hole.end());
  frame.holes.push_back(hole);
  const Region alone = rectangle(10000, 10000, 11000, 11000), beside = rectangle(12000, 10000, 13000, 11000),
               at_edge = rectangle(2000, 5000, 3000, 6000), across = rectangle(1000, 8000, 4000, 9000),
               within = rectangle(500, 20000, 1500, 21000), on_another = rectangle(10200, 10200, 10700, 10700);
  Regions some{alone, frame, beside, at_edge, across, within, on_another};
  constexpr int more = 100;  // few are not told apart
  for (int i = 0; i < more; ++i) some.push_back(rectangle(5000 + 200 * i, 25000, 5100 + 200 * i, 25500));
  const Regions joined = geometry::joined(some), united = geometry::unite(some);
  REQUIRE(joined.size() == 3 + more);
  CHECK(united.size() == 3 + more);
  CHECK(area_mm2(joined) == Approx(area_mm2(united)));
  CHECK(geometry::subtract(joined, united).empty());
  CHECK(geometry::subtract(united, joined).empty());
}

TEST_CASE("geometry: boxes meet by others, and each is in one set") {
  const std::vector<Box> boxes{{{0, 0}, {10, 10}}, {{30, 0}, {40, 10}}, {{9, 5}, {31, 6}}, {{0, 20}, {40, 30}}};
  CHECK(geometry::touching(boxes) == std::vector<std::vector<std::size_t>>{{0, 1, 2}, {3}});
}

namespace {

/// Rectangles strewn over so many places a side, offset by sets and all at once.
void check_offset_apart(std::mt19937 random, int count, unsigned places, std::array<Um, 3> offsets) {
  Regions some;
  for (int i = 0; i < count; ++i) {
    const Um x = static_cast<Um>(random() % places) * 500, y = static_cast<Um>(random() % places) * 500;
    some.push_back(rectangle(x, y, x + 700, y + 900));
  }
  some = geometry::unite(some);
  for (const Um by : offsets)
    for (const auto corner : {geometry::Corner::miter, geometry::Corner::round}) {
      const geometry::OffsetOptions options{.by = by, .corner = corner};
      const Regions apart = geometry::offset_apart(some, options), at_once = geometry::offset(some, options);
      CHECK(apart.size() == at_once.size());
      CHECK(area_mm2(apart) == Approx(area_mm2(at_once)));
    }
}

}  // namespace

TEST_CASE("geometry: an offset cluster by cluster covers what an offset covers") {
  for (unsigned n = 0; n < 30; ++n) check_offset_apart(std::mt19937(1200 + n), 30, 60, {-200, 300, 900});
}

TEST_CASE("geometry: an offset of many that stand apart covers what an offset covers") {
  for (unsigned n = 0; n < 10; ++n) check_offset_apart(std::mt19937(1400 + n), 600, 120, {-190, 310, 890});
}
