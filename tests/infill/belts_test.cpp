// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/belts.h"

#include "areas.h"
#include "geometry/offset.h"
#include "geometry/spatial_index.h"
#include "infill/infill.h"
#include "infill/shells.h"
#include "model/flow.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;
using infill::LayerAreas;
using infill::PartAreas;

namespace {

constexpr Um one_wall = 450;

Region circle(Point centre, double radius, int corners = 180) {
  Region region;
  for (int i = 0; i < corners; ++i) {
    const double a = 2 * std::numbers::pi * i / corners;
    region.outer.push_back({centre.x + rounded(radius * std::cos(a)), centre.y + rounded(radius * std::sin(a))});
  }
  return region;
}

/// A hill whose outline recedes by `step` a layer, cut in layers of 0.2 mm.
struct Hill {
  std::vector<Regions> outlines, insides;
  std::vector<infill::ShellLayer> layers;
  std::vector<LayerAreas> areas;
  ShellSettings shells;

  Hill(const Region& base, Um step, int count, Um wall = one_wall)
      : Hill(
            count, [&](int i) { return geometry::offset({base}, {.by = -i * step}); }, wall) {}

  template <class OutlineOf>
  Hill(int count, const OutlineOf& outline_of, Um wall = one_wall) {
    for (int i = 0; i < count; ++i) {
      outlines.push_back(outline_of(i));
      insides.push_back(geometry::offset(outlines.back(), {.by = -wall}));
    }
    for (std::size_t i = 0; i < outlines.size(); ++i)
      layers.push_back({static_cast<Um>(200 * (i + 1)), 200, &outlines[i], &insides[i]});
    shells.skin_line_width = 450;
    areas = infill::find_areas(shells, {}, {layers, infill::box_of(layers), 400}, 0, layers.size());
  }
  Beads solid_of(std::size_t layer) const {
    Beads beads = infill::fill({}, shells, {.areas = areas[layer], .index = layer, .height = 200, .nozzle = 400}).beads;
    std::erase_if(beads, [](const Bead& bead) { return bead.role == Role::infill; });
    return beads;
  }
};

/// A gear whose teeth lean: each layer is turned a little further.
Region gear(int teeth, double turned, double size) {
  constexpr double profile[][2] = {{0, 13}, {0.15, 13}, {0.35, 16.5}, {0.6, 16.5}, {0.8, 13}};
  Region region;
  for (int tooth = 0; tooth < teeth; ++tooth)
    for (const auto& [share, mm] : profile) {
      const double a = 2 * std::numbers::pi * (tooth + share + turned) / teeth, radius = size * mm * teeth / 17.0;
      region.outer.push_back({rounded(1000 * radius * std::cos(a)), rounded(1000 * radius * std::sin(a))});
    }
  return region;
}

/// Of belts, by the tooth of the gear that they lie in, mm.
std::vector<double> belts_by_tooth(const LayerAreas& layer, int teeth, double turned) {
  std::vector<double> mm(static_cast<std::size_t>(teeth), 0.0);
  for (const PartAreas& part : layer)
    for (const infill::BeltLine& line : part.belts)
      for (std::size_t i = line.closed ? 0 : 1; i < line.path.size(); ++i) {
        const Point a = line.path[i > 0 ? i - 1 : line.path.size() - 1], b = line.path[i], m = lerp(a, b, 0.5);
        const double at = std::atan2(m.y, m.x) / (2 * std::numbers::pi) * teeth - turned - 0.475;
        const int tooth = static_cast<int>(std::lround(at)) % teeth;
        mm[static_cast<std::size_t>(tooth < 0 ? tooth + teeth : tooth)] += distance(a, b) / 1000;
      }
  return mm;
}

}  // namespace

namespace {

/// Belts of the teeth of a gear that leans by so much of a tooth a layer, mm: the shortest and the longest, in three
/// layers.
std::vector<std::pair<double, double>> belts_of_teeth(int teeth, double lean, int walls) {
  std::vector<Regions> outlines, insides;
  std::vector<infill::ShellLayer> layers;
  constexpr int count = 13;
  const double size = walls < 3 ? 1 : 2;  // of a tooth: there is infill in it
  for (int i = 0; i < count; ++i) {
    outlines.push_back({gear(teeth, i * lean, size)});
    insides.push_back(geometry::offset(outlines.back(), {.by = -walls * one_wall}));
  }
  for (std::size_t i = 0; i < outlines.size(); ++i)
    layers.push_back({static_cast<Um>(200 * (i + 1)), 200, &outlines[i], &insides[i]});
  ShellSettings shells;
  shells.skin_line_width = 450;
  const auto areas = infill::find_areas(shells, {}, {layers, infill::box_of(layers), 400}, 0, layers.size());
  std::vector<std::pair<double, double>> out;
  for (const std::size_t layer : {5U, 6U, 7U}) {
    const auto mm = belts_by_tooth(areas[layer], teeth, static_cast<double>(layer) * lean);
    const auto [least, most] = std::minmax_element(mm.begin(), mm.end());
    out.emplace_back(*least, *most);
  }
  return out;
}

/// Lines begin and end on samples: of three in a large tooth, more of their length.
bool alike(const std::pair<double, double>& mm) {
  return mm.second - mm.first <= std::max(0.5, mm.second / 10);
}

}  // namespace

TEST_CASE("belts: equal teeth of a gear have equal belts, however the grid lies on them", "[infill][law]") {
  const int teeth = GENERATE(9, 13, 17, 20);
  constexpr int walls = 1;  // more of them close all but wide slopes
  // From 0.03 on belts are about as long as the shortest. These are leans at which all are alike; for any, see below.
  const double lean = GENERATE(0.006, 0.0103, 0.014, 0.0181, 0.0207, 0.023, 0.0255, 0.028, 0.0303, 0.0334, 0.036,
                               0.0391, 0.042, 0.0456, 0.048, 0.049);
  CAPTURE(teeth, lean);
  for (const auto& mm : belts_of_teeth(teeth, lean, walls)) {
    CAPTURE(mm.first, mm.second);
    CHECK(alike(mm));
  }
}

TEST_CASE("belts: of gears that lean by anything, equal teeth differ in few layers", "[infill][law]") {
  const int walls = GENERATE(1, 3);
  int layers = 0, belted = 0, differ = 0;
  for (const int teeth : {9, 13, 17, 20})
    for (int lean = 6; lean <= 50; lean += 2)  // thousandths
      for (const auto& mm : belts_of_teeth(teeth, lean / 1000.0, walls))
        ++layers, belted += mm.second > 0, differ += !alike(mm);
  CAPTURE(walls, layers, belted, differ);
  CHECK(4 * belted > layers);
  CHECK((walls == 1 ? 50 : 35) * differ <= layers);  // teeth twice as large: a layer is more of their lean
}

TEST_CASE("belts: under a slope lines run along the wall, side by side, all as wide as any line", "[infill]") {
  const int walls = GENERATE(1, 3);
  // Four solid layers. Walls close their width, but those above are carried: half a nozzle further in for each layer.
  const Um step = GENERATE(220, 320, 410, 500) + (walls > 1 ? 90 : 0), closed = std::min(walls * one_wall, 4 * 200);
  const Hill hill(circle({}, 20000), step, 24, walls * one_wall);
  const Um band = flow::band(450, 200);
  const std::size_t lines = static_cast<std::size_t>(std::lround(static_cast<double>(4 * step - closed) / band));
  for (std::size_t i = 6; i < 18; ++i) {
    CAPTURE(walls, step, i);
    const Beads beads = hill.solid_of(i);
    REQUIRE(beads.size() == lines);
    const geometry::SegmentIndex edge(hill.insides[i]);
    std::vector<double> depths;
    for (const Bead& bead : beads) {
      CHECK(bead.closed);
      for (const Junction& j : bead.path) CHECK(j.width == band);
      depths.push_back(edge.nearest(bead.path.front().at)->distance_um);
      for (const Junction& j : bead.path) CHECK(edge.nearest(j.at)->distance_um == Approx(depths.back()).margin(40));
    }
    std::sort(depths.begin(), depths.end());
    for (std::size_t k = 0; k < depths.size(); ++k)
      CHECK(depths[k] == Approx((static_cast<double>(k) + 0.5) * band).margin(40));
  }
}

TEST_CASE("belts: few pieces stand for a round wall, and on the mean are as far from it as they should be",
          "[infill][law]") {
  const Um radius = GENERATE(8'000, 20'000, 45'000);
  const int corners = GENERATE(1440, 170);
  const Hill hill(circle({}, radius, corners), 220, 24);  // one line
  const Um band = flow::band(450, 200);
  for (std::size_t i = 6; i < 18; ++i) {
    CAPTURE(radius, corners, i);
    const Beads beads = hill.solid_of(i);
    REQUIRE(beads.size() >= 1);
    const geometry::SegmentIndex edge(hill.insides[i]);
    for (const Bead& bead : beads) {
      REQUIRE(bead.closed);
      double um = 0, depth = 0, least = 1e9, most = 0;
      for (std::size_t j = 0; j < bead.path.size(); ++j) {
        const Point a = bead.path[j].at, b = bead.path[(j + 1) % bead.path.size()].at;
        constexpr int looks = 20;
        for (int k = 0; k < looks; ++k) {
          const double off = edge.nearest(lerp(a, b, (k + 0.5) / looks))->distance_um;
          least = std::min(least, off), most = std::max(most, off);
          um += distance(a, b) / looks, depth += off * distance(a, b) / looks;
        }
      }
      const double line = std::floor(depth / um / band) + 0.5;
      CHECK(depth / um == Approx(line * band).margin(10));  // the middle of an arc and its chord
      CHECK(least >= line * band - 38);
      CHECK(most <= line * band + 38);
      // the longest piece of an arc that is within 25 µm on both sides is √(8 r · 50 µm)
      CHECK(static_cast<double>(bead.path.size()) < 1.2 * um / std::sqrt(400 * um / (2 * std::numbers::pi)) + 2);
    }
  }
}

TEST_CASE("belts: a line away from the wall lies beside another all along, without a slit between it and the wall",
          "[infill][law]") {
  const Um band = flow::band(450, 200);
  double um = 0, alone = 0;
  for (Um slow = 60; slow <= 300; slow += 80)
    for (Um fast = 320; fast <= 640; fast += 40) {  // belts of 1.3 to 2.6 mm: up to what is filled across
      const Hill hill(16, [&](int i) {
        return Regions{
            {{{i * fast, 0}, {26000, 0}, {26000, 20000 - i * slow}, {i * fast + 1700, 20000 - i * slow}}, {}}};
      });
      for (std::size_t i = 5; i < 11; ++i)
        for (const PartAreas& part : hill.areas[i]) {
          const geometry::SegmentIndex edge(hill.insides[i]);
          std::vector<std::vector<geometry::Segment>> at_depth(6);
          const auto depth_of = [&](const infill::BeltLine& line) {
            double most = 0;
            for (const Point p : line.path) most = std::max(most, edge.nearest(p)->distance_um);
            return static_cast<std::size_t>(std::lround(most / band + 0.5));
          };
          for (const infill::BeltLine& line : part.belts)
            for (std::size_t k = 1; k < line.path.size(); ++k)
              at_depth.at(depth_of(line)).push_back({line.path[k - 1], line.path[k]});
          for (std::size_t d = 2; d < at_depth.size(); ++d) {
            if (at_depth[d].empty()) continue;
            const geometry::SegmentIndex nearer(at_depth[d - 1]);
            for (const auto& [a, b] : at_depth[d]) {
              const int looks = 1 + static_cast<int>(distance(a, b) / 50);
              for (int k = 0; k < looks; ++k) {
                um += distance(a, b) / looks;
                if (!nearer.nearest(lerp(a, b, (k + 0.5) / looks), 1.2 * band)) alone += distance(a, b) / looks;
              }
            }
          }
        }
    }
  CAPTURE(um, alone);
  CHECK(um > 1e6);
  CHECK(alone < 0.002 * um);
}

TEST_CASE("belts: one that ends where walls above turn a corner ends there with all its lines", "[infill]") {
  const Um from = 10000, to = 20000, depth = 2200;  // of a slot in the upper layers
  const Hill hill(20, [&](int i) {
    if (i < 10) return Regions{{{{0, 0}, {30000, 0}, {30000, 20000}, {0, 20000}}, {}}};
    const Um low = 20000 - depth;
    return Regions{
        {{{0, 0}, {30000, 0}, {30000, 20000}, {to, 20000}, {to, low}, {from, low}, {from, 20000}, {0, 20000}}, {}}};
  });
  const infill::PartAreas& part = hill.areas[8].at(0);  // what is solid there is no top
  const double lines = static_cast<double>(depth - one_wall) / static_cast<double>(flow::band(450, 200));
  CHECK(part.belts.size() == static_cast<std::size_t>(std::lround(lines)));
  constexpr double within = 150;  // a cell, and by so much walls may step from layer to layer beyond what carries them
  for (const infill::BeltLine& line : part.belts) {
    const auto [least, most] = std::minmax({line.path.front().x, line.path.back().x});
    CHECK(least == Approx(from).margin(within));
    CHECK(most == Approx(to).margin(within));
  }
}

TEST_CASE("belts: one below half a line is none, and walls as thick as the skin need none", "[infill]") {
  const auto [walls, step] = GENERATE(table<int, Um>({{1, 40}, {1, 150}, {2, 200}, {3, 200}}));
  CAPTURE(walls, step);
  const Hill hill(circle({}, 20000), step, 24, walls * one_wall);
  for (std::size_t i = 6; i < 18; ++i) CHECK(hill.solid_of(i).empty());
}

TEST_CASE("belts: the lines of a symmetric part's halves are mirror images", "[infill][law]") {
  Region base;  // a lens, whose slopes give belts of changing width
  for (int i = -60; i <= 60; ++i)
    base.outer.push_back({i * 400, -rounded(9000 * std::cos(i * std::numbers::pi / 140))});
  for (int i = 60; i >= -60; --i) base.outer.push_back({i * 400, rounded(9000 * std::cos(i * std::numbers::pi / 140))});
  const Hill hill(base, 340, 20);
  for (std::size_t i = 5; i < 14; ++i) {
    Regions belts;
    for (const PartAreas& part : hill.areas[i]) belts.insert(belts.end(), part.belted.begin(), part.belted.end());
    REQUIRE_FALSE(belts.empty());
    std::size_t places = 0, unlike = 0;
    for (Um x = 50; x < 24000; x += 170)
      for (Um y = 70; y < 9000; y += 90) {
        const bool here = holds(belts, {x, y});
        places += here;
        unlike += here != holds(belts, {-x, y}), unlike += here != holds(belts, {x, -y});
      }
    CAPTURE(i, places);
    CHECK(static_cast<double>(unlike) <
          0.04 * 2 * static_cast<double>(places));  // a line ends a cell of the grid later
  }
}

TEST_CASE("belts: what lies in a line of a belt is not sparse as well", "[infill][law]") {
  const Hill hill(circle({5000, -3000}, 15000), 200, 20);
  for (std::size_t i = 5; i < 14; ++i)
    for (const PartAreas& part : hill.areas[i])
      for (const infill::BeltLine& line : part.belts)
        for (const Point p : line.path) {
          CHECK(holds(part.belted, p));
          CHECK_FALSE(holds(part.sparse, p));
        }
}
