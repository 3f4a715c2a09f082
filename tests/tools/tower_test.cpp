// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/tower.h"

#include "tools/purge.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::literals;
using tools::TowerLayer;

namespace {

constexpr Rgb black{0, 0, 0}, white{255, 255, 255}, red{224, 32, 32};

double purge(Rgb from, Rgb to) {
  return tools::purge_volume_mm3(from, to, 2, 55.6);
}

std::vector<TowerLayer> two_changes(int layers) {
  std::vector<TowerLayer> out;
  for (int i = 0; i < layers; ++i) {
    const auto pass = static_cast<std::size_t>(3 * i);
    out.push_back({200 * (i + 1), 200, {{pass + 1, 140}, {pass + 2, 60}}, pass});
  }
  return out;
}

}  // namespace

TEST_CASE("tools: white after black takes several times what black after white does", "[tools]") {
  CHECK(purge(black, white) == Approx(461.85).margin(0.5));  // mm³: what another way of solving it gives
  CHECK(purge(white, black) == Approx(96.72).margin(0.5));
  CHECK(purge(red, white) == Approx(449.47).margin(0.5));
  CHECK(purge(white, red) == Approx(93.40).margin(0.5));
  CHECK(purge(red, red) == 0);
}

TEST_CASE("tools: in a nozzle of its own a tool purges its least volume, whatever the colours", "[tools]") {
  Settings own;
  own.tools.filament_colour = black;
  Settings other = own;
  other.tools.filament_colour = white;
  other.tools.prime_tower_min_volume = 20;
  CHECK(tools::purge_volumes({own, other})[0][1] == 20);
  own.tools.tool_nozzles = other.tools.tool_nozzles = 0;
  CHECK(tools::purge_volumes({own, other})[0][1] == Approx(461.85).margin(0.5));
  own.tools.purge_volumes = Numbers{0, 100, 200, 0};
  CHECK(tools::purge_volumes({own, other})[0][1] == 100);
  CHECK(tools::purge_volumes({own, other})[1][0] == 200);
  own.tools.filament_colour.reset();
  own.tools.purge_volumes.reset();
  CHECK(tools::purge_volumes({own, other})[0][1] == 140);
}

TEST_CASE("tools: every strip of a tower is at least what is to be purged, and lies within its walls", "[tools]") {
  const ToolSettings settings;
  const auto layers = two_changes(20);
  const auto size = tools::tower_size(settings, layers, 400);
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const auto beads = tools::tower_beads(settings, size, layers[i], i, {50_mm, 60_mm});
    for (const auto& strip : layers[i].strips) {
      double mm3 = 0;
      for (const auto& [pass, own, ram, height] : beads)
        if (pass == strip.pass)
          for (const auto& bead : own) mm3 += volume_mm3(bead, height);
      CHECK(mm3 >= strip.mm3);
      CHECK(mm3 < strip.mm3 + 0.11);  // mm³: two widths of a line stay
    }
    for (const auto& [pass, own, ram, height] : beads)
      for (const auto& bead : own) {
        CHECK(bead.role == Role::wipe_tower);
        const Um brim = i == 0 ? settings.prime_tower_brim_width : 0;
        const Box room{{50_mm - brim, 60_mm - brim}, {50_mm + size.width + brim, 60_mm + size.depth + brim}};
        for (const auto& junction : bead.path) CHECK(room.contains(junction.at));
      }
  }
}

TEST_CASE("tools: lines of a tower run across in the next layer", "[tools]") {
  const auto layers = two_changes(2);
  const auto size = tools::tower_size({}, layers, 400);
  const auto along_y = [&](std::size_t i) {
    const auto beads = tools::tower_beads({}, size, layers[i], i, {});
    const auto& path = beads.front().beads.front().path;
    return path[0].at.x == path[1].at.x;
  };
  CHECK_FALSE(along_y(0));
  CHECK(along_y(1));
}

TEST_CASE("tools: a tower stands where there is room, as near to what is printed as it may", "[tools]") {
  const ToolSettings settings;
  const auto layers = two_changes(10);
  const auto size = tools::tower_size(settings, layers, 400);
  const Ring bed{{0, 0}, {140_mm, 0}, {140_mm, 140_mm}, {0, 140_mm}};
  const std::vector<Box> standing{{{40_mm, 40_mm}, {60_mm, 60_mm}}};
  const auto place = tools::place_for_tower(settings, size, bed, {}, standing, 3_mm);
  REQUIRE(place);
  const auto outline = tools::tower_outline(settings, size, *place);
  CHECK(tools::outside_of(outline, bed).by == 0);
  CHECK_FALSE(box_of(outline).grown(2_mm).overlaps(standing.front()));
  const std::vector<Box> full{{{5_mm, 5_mm}, {135_mm, 135_mm}}};
  CHECK_FALSE(tools::place_for_tower(settings, size, bed, {}, full, 3_mm));
}

TEST_CASE("tools: how far a tower leaves the bed is told to the micron", "[tools]") {
  const Ring bed{{0, 0}, {100_mm, 0}, {100_mm, 100_mm}, {0, 100_mm}};
  const Ring inside{{10_mm, 10_mm}, {20_mm, 10_mm}, {20_mm, 20_mm}, {10_mm, 20_mm}};
  CHECK(tools::outside_of(inside, bed).by == 0);
  const Ring beyond{{90_mm, 10_mm}, {107_mm, 10_mm}, {107_mm, 20_mm}, {90_mm, 20_mm}};
  CHECK(tools::outside_of(beyond, bed).by == 7_mm);
}

TEST_CASE("tools: wall and grid of a tower count to what is purged, where one filament prints them all", "[tools]") {
  const ToolSettings settings;
  auto layers = two_changes(6);
  for (auto& layer : layers) {
    layer.strips = {{layer.wall_pass + 1, 15}};
    layer.wall_pass += 1;
    layer.wall_purges = true;
  }
  const auto size = tools::tower_size(settings, layers, 400);
  for (std::size_t i = 1; i < layers.size(); ++i) {
    double mm3 = 0;
    for (const auto& own : tools::tower_beads(settings, size, layers[i], i, {}))
      for (const auto& bead : own.beads) mm3 += volume_mm3(bead, layers[i].height);
    CHECK(mm3 >= 15);
    CHECK(mm3 <= 15.11);  // mm³: two widths of a line stay
  }
}

TEST_CASE("tools: where a tip is shaped is a strip of its own", "[tools]") {
  const ToolSettings settings;
  std::vector<TowerLayer> layers{{200, 200, {{1, 20, true}, {1, 140}}, 0}};
  const auto size = tools::tower_size(settings, layers, 400);
  const auto beads = tools::tower_beads(settings, size, layers[0], 0, {});
  const auto ram = std::find_if(beads.begin(), beads.end(), [](const auto& own) { return own.ram; });
  REQUIRE(ram != beads.end());
  REQUIRE(ram->beads.size() == 1);
  CHECK(ram->pass == 1);
  CHECK(volume_mm3(ram->beads.front(), 200) >= 20);
}

TEST_CASE("tools: what is purged just above a section is laid beside it, not as a film over all of the bed",
          "[tools]") {
  TowerLayer section{400, 180, {{1, 140}}, 1};
  const TowerLayer film{420, 20, {{2, 140}}, 2};
  REQUIRE(tools::lay_beside(film, section, 300, 400));
  CHECK(section.z == 420);
  CHECK(section.height == 200);
  REQUIRE(section.strips.size() == 2);
  CHECK(section.height_of(section.strips[0]) == 180);
  CHECK(section.height_of(section.strips[1]) == 200);

  const std::vector<TowerLayer> layers{{200, 200, {}, 0}, section};
  const auto size = tools::tower_size({}, layers, 400);
  CHECK(to_mm(size.width) * to_mm(size.depth) < 1.2 * (140 / 0.18 + 140 / 0.2));  // alone it covers 7,000 mm²
  for (const auto& own : tools::tower_beads({}, size, section, 1, {})) {
    double mm3 = 0;
    for (const auto& bead : own.beads) mm3 += volume_mm3(bead, own.height);
    if (own.pass != section.wall_pass) CHECK(mm3 == Approx(140).margin(0.5));
    CHECK(own.height == (own.pass == 1 && !own.beads.front().closed ? 180 : 200));
  }
}

TEST_CASE("tools: sections as high as their layers stay each on the one below", "[tools]") {
  TowerLayer section{400, 200, {{1, 140}}, 1};
  TowerLayer low{400, 100, {{1, 140}}, 1};
  const TowerLayer next{600, 200, {{2, 140}}, 2}, thin{500, 100, {{2, 140}}, 2}, idle{420, 20, {}, 2};
  CHECK_FALSE(tools::lay_beside(next, section, 300, 400));  // 0.4 mm would not hold
  CHECK_FALSE(tools::lay_beside(thin, low, 300, 400));      // more room, not less
  CHECK_FALSE(tools::lay_beside(idle, section, 300, 400));  // nothing to lay
  const TowerLayer film{520, 20, {{2, 140}}, 2};
  section.height = 320;
  CHECK(tools::lay_beside(film, section, 300, 400));  // so low a film is held by what it is laid on
  CHECK(section.z == 520);
}

TEST_CASE("tools: wider purged lines are fewer, lines farther apart take more room, and both are as much as before",
          "[tools]") {
  const auto layers = two_changes(4);
  ToolSettings fat, apart;
  fat.prime_tower_purge_width = 200;
  apart.prime_tower_purge_spacing = 150;
  const auto length = [&](const ToolSettings& settings, std::size_t i) {  // of what is purged; mm
    const auto size = tools::tower_size(settings, layers, 400);
    double mm = 0;
    for (const auto& strip : layers[i].strips) {
      double mm3 = 0;
      for (const auto& own : tools::tower_beads(settings, size, layers[i], i, {}))
        if (own.pass == strip.pass)
          for (const auto& bead : own.beads) {
            mm3 += volume_mm3(bead, own.height), mm += length_mm(bead);
            for (const auto& junction : bead.path) {  // it lies within the walls, with half its width
              const Box room = Box{{size.line, size.line}, {size.width - size.line, size.depth - size.line}};
              CHECK(room.contains(Box{junction.at, junction.at}.grown(junction.width / 2).min));
              CHECK(room.contains(Box{junction.at, junction.at}.grown(junction.width / 2).max));
            }
          }
      CHECK(mm3 >= strip.mm3 - 1e-6);
      CHECK(mm3 < strip.mm3 + 0.5);  // mm³: two widths of a line stay
    }
    return mm;
  };
  CHECK(length(fat, 2) == Approx(length({}, 2) / 2).epsilon(0.02));
  CHECK(length(apart, 2) == Approx(length({}, 2)).epsilon(0.02));
  const auto area = [&](const ToolSettings& settings) {
    const auto size = tools::tower_size(settings, layers, 400);
    return to_mm(size.width - 2 * size.line) * to_mm(size.depth - 2 * size.line);
  };
  CHECK(area(fat) == Approx(area({})).epsilon(0.15));
  CHECK(area(apart) == Approx(1.5 * area({})).epsilon(0.15));
  // Lines of a strip of the lowest section lie side by side.
  const auto size = tools::tower_size(apart, layers, 400);
  for (const std::size_t i : {std::size_t{0}, std::size_t{2}}) {
    const auto path = tools::tower_beads(apart, size, layers[i], i, {}).front().beads.front().path;
    CHECK(path[2].at.y - path[1].at.y == (i == 0 ? size.line : size.line * 3 / 2));
  }
}

TEST_CASE("tools: below its first change a plain tower is as narrow as it can stand, and leans out from there",
          "[tools]") {
  std::vector<TowerLayer> layers;
  for (int i = 0; i < 120; ++i) layers.push_back({200 * (i + 1), 200, {}, 0});
  layers.back().strips.push_back({1, 200});
  ToolSettings settings;
  const auto size = tools::tower_size(settings, layers, 400);
  const auto box = [&](std::size_t i) {
    Box out;
    for (const auto& own : tools::tower_beads(settings, size, layers[i], i, {}))
      for (const auto& bead : own.beads)
        if (bead.closed && (i > 0 || out.empty())) out.add(box_of(bead));  // the first is the wall
    return out;
  };
  CHECK(box(119).size().x == size.width - size.line);
  CHECK(to_mm(box(1).size().x) == Approx(to_mm(10_mm - size.line)).margin(0.002));
  for (std::size_t i = 1; i < layers.size(); ++i) {
    const Um out = box(i - 1).min.x - box(i).min.x;
    CHECK(out >= 0);
    CHECK(out <= 116);  // 200 µm · tan 30°
  }
  CHECK(box_of(tools::tower_outline(settings, size, {})).size().x == size.width);  // beyond the brim of its foot
  for (const auto shape : {TowerShape::ribs, TowerShape::cone}) {
    settings.prime_tower_shape = shape;
    CHECK(tools::tower_size(settings, layers, 400).foot == Point{0, 0});
  }
  settings.prime_tower_shape = TowerShape::plain;
  settings.prime_tower_flare_angle = 0;
  CHECK(tools::tower_size(settings, layers, 400).foot == Point{0, 0});
}
