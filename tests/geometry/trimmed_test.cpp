// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/trimmed.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "rectangle.h"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

namespace {

/// A star whose rays have any length.
Ring star(std::mt19937& random, Point middle, int rays) {
  Ring out;
  for (int i = 0; i < rays; ++i) {
    const double angle = 2 * 3.14159265 * i / rays, radius = 2000 + static_cast<double>(random() % 28000);
    out.push_back(
        {middle.x + static_cast<Um>(radius * std::cos(angle)), middle.y + static_cast<Um>(radius * std::sin(angle))});
  }
  return out;
}

}  // namespace

TEST_CASE("geometry: what is trimmed to a box is the same inside of it, cut and offset") {
  std::mt19937 random(7);
  std::size_t before = 0, after = 0;
  for (int n = 0; n < 200; ++n) {
    std::vector<Ring> rings;
    for (int i = 0; i < 3; ++i)
      rings.push_back(star(random, {static_cast<Um>(random() % 20000), static_cast<Um>(random() % 20000)}, 60));
    const Regions all = geometry::regions_from_rings(rings);
    const Um x = static_cast<Um>(random() % 30000) - 15000, y = static_cast<Um>(random() % 30000) - 15000;
    const Box box{{x, y}, {x + 500 + static_cast<Um>(random() % 9000), y + 500 + static_cast<Um>(random() % 9000)}};
    const Regions window{rectangle(box.min.x, box.min.y, box.max.x, box.max.y)};
    const auto inside = [&](const Regions& of) { return area_mm2(geometry::intersect(window, of)); };
    INFO(n);
    const Regions less = geometry::trimmed(all, box);
    // Where edges cross outside of the box the crossing is a whole micron, and turns them by less than one inside.
    constexpr double turned_mm2 = 0.005;
    CHECK(inside(less) == Approx(inside(all)).margin(turned_mm2));
    CHECK(area_mm2(geometry::subtract(window, less)) ==
          Approx(area_mm2(geometry::subtract(window, all))).margin(turned_mm2));
    const auto wide = [](const Regions& of) {
      return geometry::offset(of, {.by = 700, .corner = geometry::Corner::round});
    };
    CHECK(inside(wide(geometry::trimmed(all, box.grown(701)))) ==
          Approx(inside(wide(all))).margin(0.01));  // corners outside are rounded

    for (const auto& ring : geometry::rings_of(all)) before += ring.size();
    for (const auto& ring : geometry::rings_of(less)) after += ring.size();
  }
  CHECK(after * 4 < before);
}

TEST_CASE("geometry: of what surrounds a box, or misses it, no more is left than tells so") {
  const Box box{{0, 0}, {1000, 1000}};
  Ring around;
  for (int i = 0; i < 1000; ++i) {
    const double angle = 2 * 3.14159265 * i / 1000;
    around.push_back({static_cast<Um>(50000 * std::cos(angle)), static_cast<Um>(50000 * std::sin(angle))});
  }
  const Regions left = geometry::trimmed(Regions{{around, {}}}, box);
  REQUIRE(left.size() == 1);
  CHECK(left[0].outer.size() <= 12);
  CHECK(side_of(left[0].outer, {500, 500}) == Side::inside);
  CHECK(geometry::trimmed(Regions{rectangle(2000, 0, 3000, 1000)}, box).empty());
}
