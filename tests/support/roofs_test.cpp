// SPDX-License-Identifier: GPL-3.0-or-later
#include "body.h"
#include "geometry/clip_lines.h"
#include "geometry/spatial_index.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

TEST_CASE("support: a roof lies on fewer branches, and what is too narrow for one is held by tips") {
  auto body = tee();
  auto s = on(SupportStructure::tree);
  const auto roofed = planned(s, body);
  s.support_roof_enable = false;
  const auto bare = planned(s, body);
  CHECK(roofed.figures.tips < bare.figures.tips * 7 / 10);
  CHECK(area_mm2(roofed.layers.back().roof) > 0.95 * roofed.figures.needed_mm2 - 20);
  for (const auto& layer : bare.layers) CHECK(layer.roof.empty());

  Body needle;
  needle.add(30, {rectangle(0, 0, 10000, 10000)});
  needle.add(10, {rectangle(0, 0, 10000, 10000), rectangle(15000, 0, 15500, 500)});
  const auto held = planned(on(SupportStructure::tree), needle);
  REQUIRE_FALSE(held.layers.empty());
  CHECK(held.figures.tips >= 1);
  CHECK(held.figures.left_mm2 == 0);
}

TEST_CASE("support: every strand of a roof over branches lies on joists, and every joist on branches") {
  // Of joists 6.05 from branch to branch, of strands two triangles of tips one behind the other.
  constexpr double longest_mm = 7.5;
  constexpr double hangs_on_others_mm = 1;  // a strand no longer than that, by its neighbours in the zigzag
  const Region post = rectangle(-2000, -2000, 2000, 2000), wall = rectangle(-10000, 10300, 10000, 16000);
  // Beside a wall no branch stands, and strands run along it.
  for (const auto& [stem, outline] : {std::pair{post, rectangle(-10000, -20000, 10000, 20000)},
                                      std::pair{post, rectangle(-14000, -14000, 14000, 14000)},
                                      std::pair{wall, rectangle(-10000, -20000, 10000, 16000)}}) {
    Body body;
    body.add(50, {stem});
    body.add(10, {outline});
    const auto plan = planned(on(SupportStructure::tree), body);
    std::size_t roofs = 0;
    for (std::size_t k = 2; k < plan.layers.size(); ++k) {
      const auto& joists = plan.layers[k - 1].joists;
      if (joists.area.empty() || plan.layers[k].roof.empty()) continue;
      ++roofs;
      const Regions rim = geometry::subtract(joists.rimmed, geometry::offset(joists.rimmed, {.by = -400}));
      std::vector<Polyline> strands;
      for (Um y = -19900; y < 20000; y += 400) strands.push_back({{-30000, y}, {30000, y}});
      const auto carried = [&](const std::vector<Polyline>& lines, const Regions& on) {
        for (const auto& line : lines) {
          if (length_of(line) / 1000 > hangs_on_others_mm)
            CHECK_FALSE(geometry::clip_lines(std::vector<Polyline>{line}, on).empty());
          for (const auto& free : geometry::clip_lines(std::vector<Polyline>{line}, on, geometry::Keep::outside))
            CHECK(length_of(free.line) / 1000 < longest_mm);
        }
      };
      std::vector<Ring> bands;
      for (const auto& line : joists.lines)
        for (std::size_t i = 1; i < line.size(); ++i) {
          const double d = distance(line[i - 1], line[i]) / 200;
          const Point a = line[i - 1], b = line[i];
          const Point side{rounded((a.y - b.y) / d), rounded((b.x - a.x) / d)};
          bands.push_back({a - side, b - side, b + side, a + side});
        }
      Regions on = geometry::regions_from_rings(bands);
      on.insert(on.end(), rim.begin(), rim.end());
      std::vector<Polyline> inside;
      for (auto& piece : geometry::clip_lines(strands, geometry::offset(plan.layers[k].roof, {.by = -200})))
        inside.push_back(std::move(piece.line));
      CHECK(inside.size() > 50);
      carried(inside, geometry::unite(on));
      // A joist is a bead: it lies on what is no further beside its middle than half its width.
      carried(joists.lines, geometry::unite(grown(all_of(plan.layers[k - 2]), 200), rim));
    }
    CHECK(roofs == 1);
  }
}

TEST_CASE("support: a roof on one branch alone lies on two joists that cross there, and on the rim that these carry") {
  for (const Um bore : {2000, 2300, 2600}) {
    CAPTURE(bore);
    // A bore of a block, with a ceiling over it.
    Ring round;
    for (int i = 0; i < 48; ++i)
      round.push_back(
          {rounded(bore * std::cos(i * std::numbers::pi / 24)), rounded(bore * std::sin(i * std::numbers::pi / 24))});
    Region block = rectangle(-8000, -8000, 8000, 8000);
    Body body;
    block.holes = {Ring(round.rbegin(), round.rend())};
    body.add(20, {block});
    block.holes.clear();
    body.add(5, {block});
    auto s = on(SupportStructure::tree);
    s.support_bridges = true;
    const auto plan = planned(s, body);
    const auto first =
        std::find_if(plan.layers.begin(), plan.layers.end(), [](const auto& l) { return !l.roof.empty(); });
    REQUIRE(first != plan.layers.end());
    REQUIRE(first - plan.layers.begin() >= 2);
    const support::SupportLayer &carries = first[-1], &branch = first[-2];
    REQUIRE(branch.branches.size() == 1);
    const Point middle = box_of(branch.branches[0].outer).centre();
    const auto& joists = carries.joists;
    CHECK(joists.rimmed.empty());
    REQUIRE(joists.lines.size() == 2);
    for (const Polyline& line : joists.lines) {
      REQUIRE(line.size() == 3);
      CHECK(distance(line[1], middle) < 50);  // half of a grid's cell that branches are found on
    }
    CHECK(std::abs(static_cast<double>(orient(joists.lines[0][1], joists.lines[0][0], joists.lines[1][0]))) >
          0.9 * distance(joists.lines[0][0], middle) * distance(joists.lines[1][0], middle));
    REQUIRE(joists.after.size() == 1);
    CHECK(joists.after[0].front() == joists.after[0].back());
    std::vector<Point> ends;
    for (const Polyline& line : joists.lines) ends.insert(ends.end(), {line.front(), line.back()});
    const geometry::SegmentIndex rim(joists.after);
    for (const Point end : ends) CHECK(distance(rim.nearest(end)->at, end) < 400);  // beads meet
    // The roof reaches no further than the rim that carries it.
    CHECK(geometry::subtract(first->roof, grown(joists.area, 400)).empty());
  }
}

TEST_CASE("support: a branch stands on a floor, also where nothing spreads on the bed") {
  auto body = tee();
  for (const Um brim : {0, 3000}) {
    auto s = on(SupportStructure::tree);
    s.support_brim_width = brim;
    const auto plan = planned(s, body);
    REQUIRE(plan.layers.size() > 2);
    CHECK(plan.layers[0].branches.empty());  // which are hollow
    CHECK(area_mm2(plan.layers[0].columns) > 40);
    CHECK_FALSE(plan.layers[1].branches.empty());
  }
}

TEST_CASE("support: a roof on a column is dense but for its lowest level, and one that is narrow lies on the column") {
  struct Levels {
    std::size_t dense = 0, under = 0;
    double dense_mm2 = 0, under_mm2 = 0;
  };
  const auto of = [](const SupportSettings& s, const Region& plate, Um nozzle) {
    Body body;
    body.add(50, {rectangle(0, 0, 4000, 4000)});
    body.add(10, {rectangle(0, 0, 4000, 4000), plate});
    auto object = body.object();
    object.nozzle = nozzle;
    Levels out;
    bool ended = false;  // going up, nothing that carries a roof lies on it
    for (const auto& layer : support::plan(s, object, support::demand(s, object)).layers) {
      if (!layer.roof.empty()) ++out.dense, out.dense_mm2 = area_mm2(layer.roof), ended = true;
      if (layer.under_roof.empty()) continue;
      CHECK_FALSE(ended);
      CHECK(layer.columns.empty());
      ++out.under, out.under_mm2 = area_mm2(layer.under_roof);
    }
    return out;
  };
  const Region wide = rectangle(10000, 0, 30000, 20000), narrow = rectangle(10000, 0, 12500, 20000);
  auto s = on();
  for (const auto& [height, nozzle, dense] : {std::tuple{600, 400, 1}, std::tuple{300, 400, 1}, std::tuple{900, 400, 2},
                                              std::tuple{600, 600, 1}, std::tuple{100, 400, 1}}) {
    CAPTURE(height, nozzle);
    s.support_roof_height = height;
    const Levels levels = of(s, wide, nozzle);
    CHECK(levels.dense == static_cast<std::size_t>(dense));
    CHECK(levels.under == 1);
    CHECK(levels.dense_mm2 == Approx(400).epsilon(0.02));
    CHECK(levels.under_mm2 == Approx(400).epsilon(0.02));
    const Levels lone = of(s, narrow, nozzle);
    CHECK(lone.dense == static_cast<std::size_t>(dense));
    CHECK(lone.under == 0);
  }
  s = on(), s.support_synchronize_layers = true;  // levels of 0.2 mm
  CHECK(of(s, wide, 400).dense == 2);
  s.support_roof_enable = false;
  CHECK(of(s, wide, 400).under + of(s, wide, 400).dense == 0);
}
