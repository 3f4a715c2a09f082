// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/walls.h"

#include "model/flow.h"
#include "walls/shapes.h"

#include <array>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

TEST_CASE("walls: a strip narrower than one bead gets a single centred bead from end to end", "[walls]") {
  const auto walls = built({rectangle(0, 0, 10_mm, 0.4_mm)});
  REQUIRE(walls.beads.size() == 1);
  const Bead& bead = walls.beads[0];
  CHECK_FALSE(bead.closed);
  CHECK(length_mm(bead) == Approx(10.0).margin(0.01));
  for (const Junction& j : bead.path) {
    CHECK(j.at.y == Approx(200).margin(1));
    CHECK(j.width == Approx(400).margin(2));
  }
}

TEST_CASE("walls: flow compensation plans a thin rib at a stable width with less flow", "[walls]") {
  struct Row {
    Um rib, width;
    double flow;
  };
  const auto row = GENERATE(Row{50, 200, 0.25}, Row{100, 200, 0.5}, Row{200, 200, 1.0}, Row{400, 400, 1.0});
  CAPTURE(row.rib);
  const auto walls = built({rectangle(0, 0, 10_mm, row.rib)}, by_volume(), 0.8_mm);
  REQUIRE(walls.beads.size() == 1);
  for (const Junction& j : walls.beads[0].path) {
    CHECK(j.width == Approx(row.width).margin(2));
    CHECK(j.flow == Approx(row.flow).margin(0.01));
  }
}

TEST_CASE("walls: a rib thinner than min_feature_size is left out and named", "[walls]") {
  const auto walls = built({rectangle(0, 0, 10_mm, 0.04_mm)});
  CHECK(walls.beads.empty());
  REQUIRE(walls.notices.size() == 1);
  CHECK(walls.notices[0].code == "thin_feature_dropped");
}

TEST_CASE("walls: a wide part has wall_line_count closed walls of nominal width and leaves the rest inside",
          "[walls]") {
  const auto walls = built({rectangle(0, 0, 20_mm, 20_mm)});
  REQUIRE(walls.beads.size() == 3);
  for (const Bead& bead : walls.beads) CHECK(bead.closed);
  CHECK(walls.beads[0].inset == 2);
  CHECK(walls.beads[2].role == Role::outer_wall);
  CHECK(area_mm2(walls.inside) + bead_area_mm2(walls) == Approx(400).epsilon(1e-4));
}

TEST_CASE("walls: among many parts each gets the walls that it has alone", "[walls]") {
  // Alike, nearly alike, turned, with a hole, and again: in any order no part gets another's walls.
  const auto pin = [](Point at, Um width, Um depth) { return rectangle(at, at + Point{width, depth}); };
  Regions parts;
  for (Um i = 0; i < 12; ++i) {
    const Um x = 5_mm * i, size = i % 3 == 0 ? 500 : 2500;
    parts.push_back(pin({x, 0}, size, size));
    parts.push_back(pin({x, 5_mm}, size + i % 2, size));
    parts.push_back(pin({x, 10_mm}, 700, size));
    Region ring = pin({x, 15_mm}, 4_mm, 4_mm);
    if (i % 2 == 0)
      ring.holes.push_back(Ring{{x + 1000, 16_mm}, {x + 1000, 17_mm}, {x + 2000, 17_mm}, {x + 2000, 16_mm}});
    parts.push_back(ring);
  }
  const auto together = built(parts);
  Beads alone;
  Regions inside;
  for (std::uint32_t i = 0; i < parts.size(); ++i) {
    auto walls = built({parts[i]});
    for (Bead& bead : walls.beads) {
      bead.part = i;
      alone.push_back(bead);
    }
    inside.insert(inside.end(), walls.inside.begin(), walls.inside.end());
  }
  CHECK(together.beads == alone);
  CHECK(together.inside == inside);
}

TEST_CASE("walls: the order setting decides which wall comes first", "[walls]") {
  WallSettings settings = by_volume();
  settings.wall_order = WallOrder::outside_in;
  CHECK(built({rectangle(0, 0, 20_mm, 20_mm)}, settings).beads[0].inset == 0);
}

TEST_CASE("walls: alternate_extra_wall adds a wall on odd layers", "[walls]") {
  WallSettings settings = by_volume();
  settings.alternate_extra_wall = true;
  CHECK(built({rectangle(0, 0, 20_mm, 20_mm)}, settings).beads.size() == 4);
}

TEST_CASE("walls: xy offsets move outlines and holes", "[walls]") {
  WallSettings settings = by_volume();
  settings.xy_offset = 0.1_mm;
  settings.hole_xy_offset = 0.3_mm;
  const Ring hole = circle({10_mm, 10_mm}, 3_mm, 60, true);
  const auto walls = built({Region{rectangle(0, 0, 20_mm, 20_mm).outer, {hole}}}, settings);
  const double expected = 20.2 * 20.2 - std::numbers::pi * 3.2 * 3.2;
  CHECK(area_mm2(walls.inside) + bead_area_mm2(walls) == Approx(expected).epsilon(0.003));
}

TEST_CASE("walls: what draws in the first layer leaves ribs and pins as wide as they are", "[walls]") {
  WallSettings above = by_volume();
  above.wall_line_width_0 = 450;
  WallSettings settings = above;
  settings.xy_offset = -200;
  const auto printed_mm2 = [&](const Regions& regions) {
    const SlicedLayer layer{.z = 200, .height = 200, .regions = regions};
    const auto walls = walls::build(settings, {.layer = layer, .settings_above = &above});
    return area_mm2(walls.inside) + bead_area_mm2(walls);
  };
  const Um rib = GENERATE(300, 500, 800, 1'200);  // 2 x 0.45 mm and 2 x 0.2 mm are more
  CHECK(printed_mm2({rectangle(0, 0, 20_mm, rib)}) == Approx(20 * to_mm(rib)).epsilon(0.02));
  CHECK(printed_mm2({rectangle(0, 0, 20_mm, 1.5_mm)}) == Approx(19.6 * 1.1).epsilon(0.02));
  CHECK(printed_mm2({rectangle(0, 0, 20_mm, 20_mm)}) == Approx(19.6 * 19.6).epsilon(0.002));
  // A rib on a block: the block is drawn in, the rib is not, and nothing parts them.
  const Region flag{
      {{0, 0}, {10_mm, 0}, {10_mm, 5_mm}, {20_mm, 5_mm}, {20_mm, 5.5_mm}, {10_mm, 5.5_mm}, {10_mm, 10_mm}, {0, 10_mm}},
      {}};
  CHECK(printed_mm2({flag}) == Approx(9.6 * 9.6 + 10.2 * 0.5).epsilon(0.01));
}

TEST_CASE("walls: no bead is wider than max_wall_line_width allows", "[walls]") {
  const Um thickness = GENERATE(600, 900, 1200, 1500, 2100, 2700);
  const auto walls = built({rectangle(0, 0, 10_mm, thickness)});
  for (const Bead& bead : walls.beads)
    for (const Junction& j : bead.path) CHECK(j.width <= 0.9_mm);
}

TEST_CASE("walls: a wedge is filled to its tip", "[walls]") {
  const Regions wedge{{{{0, 0}, {60_mm, 1.5_mm}, {0, 3_mm}}, {}}};
  WallSettings settings = by_volume();
  settings.wall_line_count = 10;
  const auto walls = built(wedge, settings);
  CHECK(bead_area_mm2(walls) == Approx(area_mm2(wedge)).epsilon(0.01));
  Um reach = 0;
  for (const Bead& bead : walls.beads)
    for (const Junction& j : bead.path) reach = std::max(reach, j.at.x);
  CHECK(reach > 58.9_mm);  // there it is 0.05 mm thick
}

TEST_CASE("walls: twice the same layer gives the same beads", "[walls]") {
  std::mt19937 random(7);
  const Regions regions{{random_ring(random), {}}};
  CHECK(built(regions).beads == built(regions).beads);
}

TEST_CASE("walls: a part that is all corners is filled to its thickest place", "[walls]") {
  Ring star;
  for (int i = 0; i < 16; ++i) {
    const double a = std::numbers::pi * i / 8 + 0.1, r = i % 2 == 0 ? 10'000 : 6'500;
    star.push_back({rounded(r * std::cos(a)), rounded(r * std::sin(a))});
  }
  WallSettings settings = by_volume();
  settings.wall_line_count = 100;
  const Regions regions{{star, {}}};
  const auto walls = built(regions, settings);
  CHECK(bead_area_mm2(walls) == Approx(area_mm2(regions)).epsilon(0.001));
  double nearest = 1e9;
  for (const Bead& bead : walls.beads)
    for (const Junction& j : bead.path) nearest = std::min(nearest, std::hypot(j.at.x, j.at.y));
  CHECK(nearest < 500);
}

TEST_CASE("walls: where two thin ribs cross, one bead goes through and nothing circles the crossing", "[walls]") {
  const Um t = 0.5_mm, l = 3_mm;
  const Ring cross{{l, 0},
                   {l + t, 0},
                   {l + t, l},
                   {2 * l + t, l},
                   {2 * l + t, l + t},
                   {l + t, l + t},
                   {l + t, 2 * l + t},
                   {l, 2 * l + t},
                   {l, l + t},
                   {0, l + t},
                   {0, l},
                   {l, l}};
  const auto walls = built({{cross, {}}});
  CHECK(walls.beads.size() == 3);
  for (const Bead& bead : walls.beads) CHECK_FALSE(bead.closed);
}

TEST_CASE("walls: over air a bead keeps the nozzle's own strand", "[walls]") {
  const Regions strip{{{{0, 0}, {20_mm, 0}, {20_mm, 1.3_mm}, {0, 1_mm}}, {}}};
  const Regions air{rectangle(5_mm, -1_mm, 15_mm, 3_mm)};
  WallSettings settings = by_volume();
  settings.wall_line_width_0 = 0.45_mm;
  settings.wall_line_width_x = 0.45_mm;
  const SlicedLayer layer = layer_of(strip);
  const auto walls = walls::build(settings, {.layer = layer, .index = 1, .over_air = &air});
  const Um strand = flow::band(0.45_mm, 0.2_mm);
  int over_air = 0;
  for (const Bead& bead : walls.beads)
    for (const Junction& j : bead.path)
      if (j.at.x > 5_mm && j.at.x < 15_mm && j.flow == 1.F) {
        CHECK(j.width == strand);
        ++over_air;
      }
  CHECK(over_air > 0);
}

TEST_CASE("walls: a speck is left out without a word, a small part with its size", "[walls]") {
  WallSettings settings = by_volume();
  settings.min_feature_size = 0.3_mm;
  CHECK(built({rectangle(0, 0, 0.05_mm, 0.05_mm)}, settings).notices.empty());
  const auto walls = built({rectangle(0, 0, 0.25_mm, 0.2_mm)}, settings);
  CHECK(walls.beads.empty());
  REQUIRE(walls.notices.size() == 1);
  CHECK(walls.notices[0].message.find("0.250 x 0.200 mm") != std::string::npos);
}

TEST_CASE("walls: with every nozzle a thin rib gets the plastic of its own thickness", "[walls]") {
  const Um nozzle = GENERATE(0.25_mm, 0.4_mm, 0.8_mm);
  const Um rib = GENERATE(50, 100, 200, 300);
  CAPTURE(nozzle, rib);
  const auto walls = built({rectangle(0, 0, 10_mm, rib)}, by_volume(), nozzle);
  REQUIRE(walls.beads.size() == 1);
  CHECK(bead_area_mm2(walls) == Approx(10 * to_mm(rib)).epsilon(0.01));
  for (const Junction& j : walls.beads[0].path) {
    CHECK(j.width >= 0.2_mm);
    CHECK(j.width * static_cast<double>(j.flow) == Approx(rib).margin(2));
  }
}

TEST_CASE("walls: on a comb no rib is lost down to min_feature_size", "[walls]") {
  Ring comb{{0, 0}, {17_mm, 0}, {17_mm, 3_mm}};
  for (int i = 4; i >= 0; --i) {
    const Um x = 1_mm + i * 3_mm, t = std::array{50, 100, 200, 300, 400}[static_cast<std::size_t>(i)];
    for (const Point p : {Point{x + t, 3_mm}, {x + t, 11_mm}, {x, 11_mm}, {x, 3_mm}}) comb.push_back(p);
  }
  comb.push_back({0, 3_mm});
  const auto walls = built({{comb, {}}});
  for (int i = 0; i < 5; ++i) {
    Um low = 11_mm, high = 0;
    for (const Bead& bead : walls.beads)
      for (const Junction& j : bead.path)
        if (std::abs(j.at.x - 1_mm - i * 3_mm) < 0.5_mm && j.at.y > 2.5_mm)  // below lies the back's own wall
          low = std::min(low, j.at.y), high = std::max(high, j.at.y);
    CAPTURE(i);
    CHECK(high > 10.9_mm);
    CHECK(low < 3.3_mm);
  }
}

TEST_CASE("walls: flow ratios of compensated beads stay within their limits", "[walls]") {
  WallSettings settings = by_volume();
  const Ring fin{{0, 0}, {8_mm, 0}, {8_mm, 2_mm}, {16_mm, 2_mm}, {16_mm, 2080}, {8_mm, 2080}, {8_mm, 4_mm}, {0, 4_mm}};
  for (const auto& [least, most] : {std::pair{60.0, 100.0}, {5.0, 30.0}, {45.0, 50.0}}) {
    settings.min_flow_ratio = least, settings.max_flow_ratio = most;
    for (const Ring& ring : {fin, Ring{{0, 0}, {10_mm, 0}, {10_mm, 90}, {0, 90}}}) {
      std::size_t compensated = 0;
      for (const Bead& bead : built({{ring, {}}}, settings).beads)
        for (const Junction& j : bead.path) {
          if (j.flow == 1.F) continue;
          ++compensated;
          CHECK(static_cast<double>(j.flow) >= least / 100 - 1e-6);
          CHECK(static_cast<double>(j.flow) <= most / 100 + 1e-6);
        }
      CHECK(compensated > 0);
    }
  }
}

TEST_CASE("walls: a lower min_wall_line_width loses no rib and splits none into strands too thin to lie", "[walls]") {
  const Um nozzle = GENERATE(0.4_mm, 0.8_mm);
  const bool compensate = GENERATE(true, false);
  WallSettings settings = by_volume();
  settings.flow_compensation = compensate;
  for (const Um rib : {60, 100, 150, 200, 300, 390}) {
    double before = 0;
    for (const Um least : {340, 200, 100, 50, 20, 5}) {
      CAPTURE(nozzle, compensate, rib, least);
      settings.min_wall_line_width = length(least);
      const auto walls = built({rectangle(0, 0, 10_mm, rib)}, settings, nozzle);
      CHECK(bead_area_mm2(walls) >= 0.98 * before);
      before = bead_area_mm2(walls);
      if (rib <= 200 && compensate) CHECK(walls.beads.size() == 1);
    }
    CHECK(before > 0);
  }
  settings.min_wall_line_width = length(50);
  CHECK(walls::check(settings, nozzle, 0.2_mm).size() == 1);
  settings.min_wall_line_width = length(nozzle / 2);
  CHECK(walls::check(settings, nozzle, 0.2_mm).empty());
}

TEST_CASE("walls: the overlap factor moves beads together, and does not change their width", "[walls]") {
  WallSettings settings;
  settings.wall_line_width_0 = settings.wall_line_width_x = 0.5_mm;
  settings.wall_corner_width = 100;
  for (const double factor : {1.0, 0.5, 0.0}) {
    settings.overlap_factor = factor;
    const auto walls = built({rectangle(0, 0, 20_mm, 20_mm)}, settings);
    REQUIRE(walls.beads.size() == 3);
    std::array<Um, 3> right{};
    for (const Bead& bead : walls.beads) {
      right[bead.inset] = box_of(bead).max.x;
      for (const Junction& j : bead.path) CHECK(flow::line_width(j.width, 0.2_mm) == Approx(500).margin(2));
    }
    CHECK(right[0] == Approx(19'750).margin(1.5));  // its widest point is on the outline
    CHECK(right[0] - right[1] == Approx(500 - 200 * flow::rounding * factor).margin(2));
    CHECK(right[1] - right[2] == Approx(500 - 200 * flow::rounding * factor).margin(2));
  }
}
