// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/nudge.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "geometry/trimmed.h"
#include "shapes.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::geometry;

TEST_CASE("geometry: what lies beyond others that are a hair wider is what a sweep leaves", "[law]") {
  shapes::Dice dice(31);
  constexpr Um hair = 3;
  for (int i = 0; i < 400; ++i) {
    const Regions first{{shapes::star(dice, {0, 0}, 9000, dice.between(3, 40)), {}}};
    const Regions hole{{shapes::star(dice, {0, 0}, 4000, dice.between(3, 12)), {}}};
    const Regions second{{shapes::star(dice, {dice.between(-6000, 6000), 2000}, 9000, dice.between(3, 20)), {}}};
    // Two that overlap, and what is left of them where the region was cut before: their outlines lie on each other.
    Regions others = subtract(second, hole);
    const Regions cut = subtract(subtract(first, hole), others);
    others.push_back({shapes::star(dice, {0, dice.between(-9000, 9000)}, 5000, 9), {}});
    for (const Region& region : i % 2 == 0 ? cut : first) {
      const Regions near = trimmed(others, box_of(region.outer).grown(4 * hair));
      const Regions left = beyond(region, near, hair);
      const Regions swept = subtract({region}, nudged_out(others, hair));
      INFO(i);
      CHECK(area_mm2(exclusive_or(left, swept)) < 0.03);
      CHECK(area_mm2(subtract(left, {region})) < 0.03);
      CHECK(area_mm2(subtract(subtract({region}, others), left)) < 4e-6 * hair * 400'000);
      const Regions on = covered(region, near, hair);
      CHECK(area_mm2(exclusive_or(on, intersect({region}, others))) < 8e-6 * hair * 400'000);
    }
  }
}

TEST_CASE("geometry: what others cover all of stays as it was, and of what they do not nothing is left") {
  const Region region{{{0, 0}, {900, 0}, {1000, 1000}, {0, 1000}}, {}};
  const auto box = [](Um from, Um to) { return Region{{{from, -9}, {to, -9}, {to, 1009}, {from, 1009}}, {}}; };
  CHECK(covered(region, {box(-9, 500), box(499, 1009)}, 3) == Regions{region});
  CHECK(covered(region, {region}, 3) == Regions{region});
  CHECK(covered(region, {box(2000, 3000)}, 3).empty());
  CHECK(covered(region, {}, 3).empty());
}
