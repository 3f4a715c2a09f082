// SPDX-License-Identifier: GPL-3.0-or-later
#include "adhesion/ears.h"

#include "adhesion/adhesion.h"
#include "core/polygon.h"
#include "geometry/offset.h"
#include "rectangle.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::literals;
using adhesion::tips_of;
using test::rectangle;

namespace {

Region regular(int corners, Um radius) {
  Region out;
  for (int i = 0; i < corners; ++i) {
    const double a = 2 * std::numbers::pi * i / corners;
    out.outer.push_back({rounded(radius * std::cos(a)), rounded(radius * std::sin(a))});
  }
  return out;
}

/// Corners rounded with that radius.
Regions rounded_off(const Region& region, Um radius) {
  return geometry::opening({region}, radius);
}

}  // namespace

TEST_CASE("brim ears: each corner sharper than asked is a tip, rounded or not") {
  const Region square = rectangle(0, 0, 30_mm, 20_mm);
  CHECK(tips_of({square}, 125).size() == 4);
  CHECK(tips_of({square}, 80).empty());
  for (const Um radius : {500, 1000, 1500}) {
    INFO("rounded by " << radius);
    const auto tips = tips_of(rounded_off(square, radius), 125);
    CHECK(tips.size() == 4);
    for (const Point tip : tips) {
      const double dx = std::min(std::abs(tip.x), std::abs(tip.x - 30'000)),
                   dy = std::min(std::abs(tip.y), std::abs(tip.y - 20'000));
      CHECK(std::hypot(dx, dy) <= 0.45 * radius);
    }
  }
  CHECK(tips_of({regular(3, 20_mm)}, 125).size() == 3);
  CHECK(tips_of({regular(6, 20_mm)}, 125).size() == 6);  // 120°
  CHECK(tips_of({regular(8, 20_mm)}, 125).empty());      // 135°
  CHECK(tips_of({regular(8, 20_mm)}, 140).size() == 8);
  CHECK(tips_of({regular(200, 20_mm)}, 125).empty());
}

TEST_CASE("brim ears: the ends of what is thin are tips, and where it meets the rest is none") {
  CHECK(tips_of({rectangle(0, 0, 40_mm, 3_mm)}, 125).size() == 4);
  CHECK(tips_of({rectangle(0, 0, 40_mm, 1_mm)}, 125).size() >= 2);
  // A spike of 1 mm on a disc.
  Region spiked = regular(100, 20_mm);
  std::vector<Point> outer;
  for (const Point p : spiked.outer) {
    if (std::abs(p.y) < 700 && p.x > 0) continue;
    outer.push_back(p);
  }
  std::rotate(outer.begin(), std::find_if(outer.begin(), outer.end(), [](Point p) { return p.x > 15'000 && p.y > 0; }),
              outer.end());
  for (const Point p : {Point{19'900, -500}, {30'000, -500}, {30'000, 500}, {19'900, 500}}) outer.push_back(p);
  const auto tips = tips_of({{outer, {}}}, 125);
  REQUIRE_FALSE(tips.empty());
  for (const Point tip : tips) CHECK(tip.x > 29'000);
}

TEST_CASE("brim ears: the brim is a disc at each tip, and nothing elsewhere") {
  AdhesionSettings settings;
  settings.skirt_line_count = 0, settings.skirt_brim_line_width = 450;
  settings.brim_width = 5_mm, settings.brim_ears = true;
  const Regions square{rectangle(0, 0, 40_mm, 40_mm)};
  const adhesion::PlateLayer layer{square, 200};
  const auto built = adhesion::build(settings, {std::span(&layer, 1), 400, nullptr});
  REQUIRE(built.layers.size() == 1);
  REQUIRE_FALSE(built.layers[0].empty());
  double mm2 = 0;
  for (const Bead& bead : built.layers[0]) {
    mm2 += volume_mm3(bead, 200) / 0.2;
    for (const Junction& j : bead.path) {
      double least = 1e9;
      for (const Point corner : square[0].outer) least = std::min(least, distance(j.at, corner));
      CHECK(least <= 5'010);
    }
  }
  // Three quarters of a disc at each of four corners, less what rings of half a width leave.
  CHECK(mm2 == Approx(3 * std::numbers::pi * 25).epsilon(0.08));
  settings.brim_ears_max_angle = 60;
  const auto none = adhesion::build(settings, {std::span(&layer, 1), 400, nullptr});
  CHECK(none.layers[0].empty());
  REQUIRE(none.notices.size() == 1);
  CHECK(none.notices[0].code == "brim_no_tips");
}

TEST_CASE("brim ears: each is laid whole before the next") {
  AdhesionSettings settings;
  settings.skirt_line_count = 0, settings.skirt_brim_line_width = 450;
  settings.brim_width = 5_mm, settings.brim_ears = true;
  const Regions square{rectangle(0, 0, 40_mm, 40_mm)};
  const adhesion::PlateLayer layer{square, 200};
  const auto built = adhesion::build(settings, {std::span(&layer, 1), 400, nullptr});
  REQUIRE(built.layers.size() == 1);
  std::map<std::uint32_t, std::set<std::size_t>> corners;  // of what is laid together
  for (const Bead& bead : built.layers[0])
    for (std::size_t c = 0; c < 4; ++c)
      if (distance(bead.path.front().at, square[0].outer[c]) < 6'000) corners[bead.sequence].insert(c);
  CHECK(corners.size() == 4);
  for (const auto& [sequence, of] : corners) CHECK(of.size() == 1);
}
