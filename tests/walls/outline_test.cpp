// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/flow.h"
#include "walls/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

namespace {

/// Corners keep their width, so that only what lies on the outline is looked at.
WallSettings with_outline(WallOutline outline) {
  WallSettings settings;
  settings.wall_outline = outline;
  settings.wall_corner_width = 100;
  settings.wall_line_width_0 = 0.45_mm;
  return settings;
}

/// How far a bead's widest point stands out to the left of its greatest X.
double rightmost_um(const WallLayer& walls, Um height) {
  double most = -1e9;
  for (const Bead& bead : walls.beads)
    for (const Junction& j : bead.path) most = std::max(most, j.at.x + flow::line_width(j.width, height) / 2.0);
  return most;
}

WallLayer built_at(Um height, const Regions& regions, const WallSettings& settings) {
  const SlicedLayer layer{height, height, regions};
  return walls::build(settings, {.layer = layer, .index = 1, .nozzle_diameter = 0.4_mm});
}

}  // namespace

TEST_CASE("walls: with wall_outline = widest the widest point of the outermost bead lies on the outline", "[walls]") {
  const Um height = GENERATE(0.1_mm, 0.2_mm, 0.3_mm);
  const Region square = rectangle(0, 0, 20_mm, 20_mm);
  CHECK(rightmost_um(built_at(height, {square}, with_outline(WallOutline::widest)), height) ==
        Approx(20'000).margin(1.1));
  // A rectangle of the bead's volume ends there instead, and half of what rounds it bulges over it.
  CHECK(rightmost_um(built_at(height, {square}, with_outline(WallOutline::volume)), height) ==
        Approx(20'000 + to_mm(height) * 1000 * flow::rounding / 2).margin(1.1));
}

TEST_CASE("walls: with wall_outline = widest a pin of the hole's size fits", "[walls]") {
  const Point centre{10_mm, 10_mm};
  Region plate = rectangle(0, 0, 20_mm, 20_mm);
  plate.holes.push_back(circle(centre, 2.5_mm, 120, true));
  for (const auto& [outline, radius] : {std::pair{WallOutline::widest, 2500.0}, {WallOutline::volume, 2478.5}}) {
    const auto walls = built_at(0.2_mm, {plate}, with_outline(outline));
    double least = 1e9;
    for (const Bead& bead : walls.beads)
      for (std::size_t i = 0; i < bead.path.size() && bead.inset == 0; ++i) {
        const Junction &a = bead.path[i], &b = bead.path[(i + 1) % bead.path.size()];
        const Point middle{(a.at.x + b.at.x) / 2, (a.at.y + b.at.y) / 2};
        least = std::min(least, distance(centre, middle) - flow::line_width(a.width, 0.2_mm) / 2.0);
      }
    // The circle's polygon stands 0.9 µm off, moves up to half of tolerances::path on either side of that.
    CHECK(least == Approx(radius).margin(6));
  }
}

TEST_CASE("walls: with wall_outline = widest a single bead is as wide as its rib", "[walls]") {
  // From strands wider than high, which are rounded, to those narrower than high, which are not.
  const Um height = GENERATE(0.1_mm, 0.2_mm, 0.3_mm);
  const Um rib = GENERATE(40, 55, 70, 100, 150, 200, 250, 300, 400, 500);
  CAPTURE(height, rib);
  WallSettings settings = with_outline(WallOutline::widest);
  settings.min_feature_size = 0.03_mm;
  settings.min_flow_ratio = 0.1;
  const auto walls = built_at(height, {rectangle(0, 0, 10_mm, rib)}, settings);
  REQUIRE(walls.beads.size() == 1);
  const double least = height * (1 - flow::rounding);  // a strand as wide as high
  const double expected = rib < least ? rib : std::max(least, rib - height * flow::rounding);
  for (const Junction& j : walls.beads[0].path) {
    CHECK(j.width * static_cast<double>(j.flow) == Approx(expected).margin(2.5));
    CHECK(j.at.y == Approx(rib / 2.0).margin(1));
  }
  // Its ends are round, too.
  CHECK(length_mm(walls.beads[0]) == Approx(10).margin(0.08));
}

TEST_CASE("walls: with wall_outline = widest what is thinner than min_feature_size is named", "[walls]") {
  // A fin on a block, and a needle: of both only what is too thin goes, and its length is told.
  const Um height = 0.3_mm;
  const WallSettings settings = with_outline(WallOutline::widest);
  const Ring fin{{0, 0}, {5_mm, 0}, {5_mm, 2_mm}, {8_mm, 2_mm}, {8_mm, 2030}, {5_mm, 2030}, {5_mm, 4_mm}, {0, 4_mm}};
  const auto walls = built_at(height, {{fin, {}}}, settings);
  REQUIRE(walls.notices.size() == 1);
  CHECK(walls.notices[0].message.find("mm of a part too thin for a bead of its own") != std::string::npos);
  CHECK(walls.notices[0].at.x == Approx(6'500).margin(60));  // the middle of the fin, not of the part
  CHECK(walls.notices[0].at.y == Approx(2'015).margin(15));
  CHECK(rightmost_um(walls, height) == Approx(5'000).margin(40));
  const Ring kept{{0, 0}, {5_mm, 0}, {5_mm, 2_mm}, {8_mm, 2_mm}, {8_mm, 2060}, {5_mm, 2060}, {5_mm, 4_mm}, {0, 4_mm}};
  const auto whole = built_at(height, {{kept, {}}}, settings);
  CHECK(whole.notices.empty());
  CHECK(rightmost_um(whole, height) == Approx(8'000).margin(120));
}

TEST_CASE("walls: parts of a layer keep their numbers where drawing in the outline parts one in two", "[walls]") {
  // A neck of 30 µm between two blocks, and a block beside: infill finds the walls' parts by the slice.
  const Ring neck{{0, 0},        {5_mm, 0},    {5_mm, 2_mm}, {6_mm, 2_mm}, {6_mm, 0},    {11_mm, 0},
                  {11_mm, 4_mm}, {6_mm, 4_mm}, {6_mm, 2030}, {5_mm, 2030}, {5_mm, 4_mm}, {0, 4_mm}};
  const auto walls = built({{neck, {}}, rectangle(20_mm, 0, 25_mm, 4_mm)}, with_outline(WallOutline::widest));
  for (const Bead& bead : walls.beads) CHECK(bead.part == (bead.path.front().at.x > 15_mm ? 1U : 0U));
}
