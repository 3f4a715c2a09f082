// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/along_path.h"

#include "geometry/boolean.h"
#include "shapes.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::geometry;

TEST_CASE("geometry: places along a path are told what an index tells of each", "[law]") {
  shapes::Dice dice(47);
  std::size_t near_ones = 0, within_ones = 0, places_asked = 0;
  for (int i = 0; i < 60; ++i) {
    Regions regions;
    for (int k = dice.between(0, 4); k > 0; --k)
      regions.push_back(
          {shapes::star(dice, {dice.between(-9000, 9000), dice.between(-9000, 9000)}, 6000, dice.between(3, 30)), {}});
    regions = unite(regions);
    const SegmentIndex index(regions);
    // Steps of fractions of a bead, now and then a leap, and places on corners.
    std::vector<Point> places;
    Point at{dice.between(-9000, 9000), dice.between(-9000, 9000)};
    for (int k = 0; k < 120; ++k) {
      const Um step = dice.between(0, 9) == 0 ? 5000 : 300;
      at = at + Point{dice.between(-step, step), dice.between(-step, step)};
      if (!regions.empty() && dice.between(0, 30) == 0) at = regions.front().outer.front();
      places.push_back(at);
    }
    const double within = dice.between(0, 600);
    const auto near = lie_near(places, index, within), on = lie_within(places, index);
    REQUIRE(near.size() == places.size());
    REQUIRE(on.size() == places.size());
    for (std::size_t k = 0; k < places.size(); ++k) {
      INFO(i << ", " << k);
      CHECK((near[k] != 0) == index.nearest(places[k], within).has_value());
      CHECK((on[k] != 0) == index.region_at(places[k]).has_value());
      near_ones += near[k] != 0, within_ones += on[k] != 0, ++places_asked;
    }
  }
  CHECK(near_ones > places_asked / 50);
  CHECK(near_ones < places_asked / 2);
  CHECK(within_ones > places_asked / 10);
  CHECK(within_ones < places_asked * 9 / 10);
  CHECK(lie_near({}, SegmentIndex(), 100).empty());
  CHECK(lie_within({}, SegmentIndex()).empty());
}
