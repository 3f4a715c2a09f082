// SPDX-License-Identifier: GPL-3.0-or-later
#include "slice/counterbore.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::literals;
using slice::counterbore_ceiling;

namespace {

constexpr auto partial = CounterboreHoleBridging::partial, sacrificial = CounterboreHoleBridging::sacrificial;
constexpr Um line = 0.4_mm;

/// @param turned of its first corner
Ring polygon(int corners, Um radius, Point at = {}, double turned_deg = 0) {
  Ring out;
  for (int i = 0; i < corners; ++i) {
    const double a = turned_deg * std::numbers::pi / 180 + 2 * std::numbers::pi * i / corners;
    const auto r = static_cast<double>(radius);
    out.push_back({at.x + rounded(r * std::cos(a)), at.y + rounded(r * std::sin(a))});
  }
  return out;
}

Regions plate_with(std::vector<Ring> holes) {
  for (auto& hole : holes) std::reverse(hole.begin(), hole.end());
  return {{{{-20_mm, -20_mm}, {20_mm, -20_mm}, {20_mm, 20_mm}, {-20_mm, 20_mm}}, std::move(holes)}};
}
Regions filled(Ring ring) {
  return {{std::move(ring), {}}};
}

slice::CounterboreCeiling of(const Regions& below, const Regions& above, CounterboreHoleBridging how = partial) {
  return counterbore_ceiling({&below, &above, &above, &above}, how, line);
}

/// How far it reaches between two lines in a direction.
double reach(const Regions& what, double degrees) {
  const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
  double low = 1e18, high = -1e18;
  for (const auto& region : what)
    for (const Point p : region.outer) {
      const double u = c * static_cast<double>(p.x) + s * static_cast<double>(p.y);
      low = std::min(low, u), high = std::max(high, u);
    }
  return high - low;
}

}  // namespace

TEST_CASE("counterbore: strips leave a slot across the wider hole, those of the next layer a square") {
  const auto wide = polygon(48, 3_mm), hole = polygon(32, 1.5_mm);
  const auto below = plate_with({wide}), above = plate_with({hole});
  const auto ceiling = of(below, above);
  REQUIRE(ceiling.holes == 1);
  CHECK(ceiling.closed.empty());
  const auto slot = geometry::unite(ceiling.open, filled(hole));
  CHECK(reach(slot, 0) == Approx(6000).margin(2));
  CHECK(reach(slot, 90) == Approx(3000).margin(2));
  CHECK(geometry::subtract(slot, filled(wide)).empty());
  const auto square = geometry::unite(ceiling.open_next, filled(hole));
  CHECK(area_mm2(square) == Approx(9).epsilon(0.001));
  CHECK(geometry::intersect(ceiling.open, filled(hole)).empty());
  // Every point of the first layer's material over the wider hole lies on a straight strand that two sides hold.
  const auto strips = geometry::subtract(geometry::subtract(filled(wide), ceiling.open), filled(hole));
  REQUIRE(strips.size() == 2);
  for (const auto& strip : strips) {
    const Box box = box_of(strip.outer);
    CHECK((box.min.y >= 1499 || box.max.y <= -1499));
  }
  // What the next layer adds over the slot crosses the strips, and reaches from one to the other.
  const auto added = geometry::subtract(ceiling.open, ceiling.open_next);
  for (const auto& part : added) {
    const Box box = box_of(part.outer);
    CHECK((box.min.x >= 1499 || box.max.x <= -1499));
  }
}

TEST_CASE("counterbore: strips go along the flats of a hexagon, however it is turned") {
  const double turned = GENERATE(0., 10., 30., 47.);
  const auto hole = polygon(6, 1.5_mm, {}, turned);
  const auto ceiling = of(plate_with({polygon(64, 4_mm)}), plate_with({hole}));
  REQUIRE(ceiling.holes == 1);
  const auto slot = geometry::unite(ceiling.open, filled(hole));
  double narrowest = 1e18;
  for (int i = 0; i < 6; ++i) narrowest = std::min(narrowest, reach(slot, turned + 30 + 60 * i));
  // An edge of 1.5 mm with corners on the lattice is off its direction by up to a micron, a slot of 8 mm by five.
  CHECK(narrowest == Approx(1500 * std::sqrt(3.)).margin(6));
}

TEST_CASE("counterbore: of a long wider hole strips go across") {
  const Ring wide{{-6_mm, -2_mm}, {6_mm, -2_mm}, {6_mm, 2_mm}, {-6_mm, 2_mm}};
  const auto hole = polygon(32, 1_mm);
  const auto ceiling = of(plate_with({wide}), plate_with({hole}));
  const auto slot = geometry::unite(ceiling.open, filled(hole));
  CHECK(reach(slot, 0) == Approx(2000).margin(2));
  CHECK(reach(slot, 90) == Approx(4000).margin(2));
}

TEST_CASE("counterbore: of a boss within a box the boss's own hole counts") {
  const auto boss = [](Um radius) {
    auto out = plate_with({polygon(4, 15_mm, {}, 45)});
    auto hole = polygon(32, radius);
    std::reverse(hole.begin(), hole.end());
    out.push_back({polygon(48, 5_mm), {hole}});
    return out;
  };
  const auto ceiling = of(boss(3_mm), boss(1_mm));
  REQUIRE(ceiling.holes == 1);
  CHECK(reach(ceiling.open, 0) == Approx(6000).margin(2));
}

TEST_CASE("counterbore: what hangs nowhere, or cannot be crossed, is left as it is") {
  const auto wide = polygon(48, 3_mm), hole = polygon(32, 1.5_mm);
  const auto below = plate_with({wide}), above = plate_with({hole});
  const auto none = [](const slice::CounterboreCeiling& c) {
    return c.holes == 0 && c.open.empty() && c.open_next.empty() && c.closed.empty();
  };
  SECTION("the same hole, or a cone's") {
    CHECK(none(of(below, below)));
    CHECK(none(of(below, plate_with({polygon(48, 2.8_mm)}))));
  }
  SECTION("a hole over solid") {
    CHECK(none(of(plate_with({}), above)));
  }
  SECTION("a hole at the wider one's edge") {
    CHECK(none(of(below, plate_with({polygon(32, 1.5_mm, {1.2_mm, 0})}))));
  }
  SECTION("something stands in the wider one") {
    auto stands = below;
    stands.push_back({polygon(16, 0.5_mm, {2.3_mm, 0}), {}});
    CHECK(none(of(stands, above)));
  }
  SECTION("two holes over it") {
    CHECK(none(of(plate_with({polygon(48, 6_mm)}),
                  plate_with({polygon(32, 1_mm, {-2_mm, 0}), polygon(32, 1_mm, {2_mm, 0})}))));
  }
  SECTION("nothing above closes the slot") {
    CHECK(none(counterbore_ceiling({&below, &above, &above, &below}, partial, line)));
    const Regions nothing;
    CHECK(none(counterbore_ceiling({&below, &above, &above, &nothing}, partial, line)));
  }
}

TEST_CASE("counterbore: a sacrificial layer closes the hole itself, also where there are two") {
  const auto a = polygon(32, 1_mm, {-2_mm, 0}), b = polygon(32, 1_mm, {2_mm, 0});
  const auto ceiling = of(plate_with({polygon(48, 6_mm)}), plate_with({a, b}), sacrificial);
  CHECK(ceiling.holes == 2);
  CHECK(ceiling.open.empty());
  CHECK(area_mm2(ceiling.closed) == Approx(area_mm2(filled(a)) + area_mm2(filled(b))));
}

TEST_CASE("counterbore: moving the layers moves what is done to them") {
  const Point by{12_mm, -7_mm};
  const auto below = plate_with({polygon(48, 3_mm)}), above = plate_with({polygon(6, 1.5_mm, {}, 20)});
  const auto here = of(below, above), there = of(moved(below, by), moved(above, by));
  CHECK(area_mm2(geometry::exclusive_or(moved(here.open, by), there.open)) < 0.01);
  CHECK(area_mm2(geometry::exclusive_or(moved(here.open_next, by), there.open_next)) < 0.01);
}
