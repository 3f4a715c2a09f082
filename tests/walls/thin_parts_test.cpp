// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/boolean.h"
#include "walls/shapes.h"
#include "walls/stub.h"
#include "walls/walls.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

namespace {

/// Where the pieces of a bead lie, each as wide as it is on average.
Regions bands_of(const Beads& beads) {
  std::vector<Ring> rings;
  for (const Bead& bead : beads)
    for (std::size_t k = 1; k < bead.path.size(); ++k) {
      const Junction &a = bead.path[k - 1], &b = bead.path[k];
      const double dx = b.at.x - a.at.x, dy = b.at.y - a.at.y, length = std::hypot(dx, dy),
                   half = (a.width + b.width) / 4.0;
      const Point n{rounded(-half * dy / length), rounded(half * dx / length)};
      rings.push_back({a.at - n, b.at - n, b.at + n, a.at + n});
    }
  return geometry::regions_from_rings(rings);
}

}  // namespace

TEST_CASE("walls: a triangle hardly larger than a bead keeps its volume and little of it lies beside it", "[walls]") {
  // What its one bead does not reach in the corners lies beside the sides: 5.1 % on average.
  WallSettings settings = by_volume();
  settings.flow_compensation = false;
  double beside = 0;
  int count = 0;
  for (const Um size : {500, 600, 700, 800})
    for (const Um lean : {-200, 0, 150, 500}) {
      CAPTURE(size, lean);
      const Regions part{{{{0, 0}, {size, 0}, {size / 2 + lean, size}}, {}}};
      const auto walls = built(part, settings);
      const double area = area_mm2(part);
      const Regions bands = bands_of(walls.beads);
      CHECK(bead_area_mm2(walls) == Approx(area).epsilon(0.005));
      beside += (area_mm2(bands) - area_mm2(geometry::intersect(part, bands))) / area;
      ++count;
    }
  CHECK(beside / count < 0.055);
}

TEST_CASE("walls: a part smaller than a dab gets one bead of its volume in few pieces", "[walls]") {
  // In pieces as wide as the part is, 16 junctions of them, each would swell over those before it.
  WallSettings settings = by_volume();
  settings.wall_line_width_0 = settings.wall_line_width_x = 0.45_mm;
  const Regions part{{circle({0, 0}, 180, 24), {}}};
  const auto walls = built(part, settings);
  REQUIRE(walls.beads.size() == 1);
  CHECK(walls.beads.front().path.size() <= 4);
  CHECK(bead_area_mm2(walls) == Approx(area_mm2(part)).epsilon(0.005));
}

TEST_CASE("walls: a small part is one bead, however little each bead may be", "[walls]") {
  // The corner of a triangle that its bead does not reach, and the sides of a lens that it does not fill, had one, two
  // and four beads of their own, shorter than a nozzle is wide.
  WallSettings settings = by_volume();
  settings.flow_compensation = false;
  settings.min_feature_size = 1;
  settings.min_wall_length = 0;
  const Regions triangle{{{{0, 0}, {600, 0}, {800, 600}}, {}}};
  const Regions lens{{{{0, 0}, {300, -180}, {700, -260}, {1100, -180}, {1400, 0}, {1100, 160}, {300, 160}}, {}}};
  for (const Regions& part : {triangle, lens}) {
    const auto walls = built(part, settings);
    CHECK(walls.beads.size() == 1);
    CHECK(bead_area_mm2(walls) == Approx(area_mm2(part)).epsilon(0.005));
  }
}

TEST_CASE("walls: a short bead lies half-way between the sides of a part, not along one of them", "[walls]") {
  // 1 mm long, 0.3 mm wide at one end and 0.6 mm at the other, with no edge in the bead's direction.
  const std::vector<walls::Place> ring{{0, 100}, {1000, 0}, {1100, 600}, {50, 400}};
  const auto path = walls::stub_bead(ring);
  REQUIRE(path.size() > 2);
  const auto& a = path.front().at;
  const auto& b = path.back().at;
  const double way = std::atan2(b.y - a.y, b.x - a.x), lower = std::atan2(-100, 1000), upper = std::atan2(200, 1050);
  CHECK(std::abs(std::remainder(way - (lower + upper) / 2, std::numbers::pi)) < 0.01);
}

TEST_CASE("walls: a tip of a part with walls has no bead that lays less than oozes on the way to it", "[walls][law]") {
  // Horns beside a bay: a bead of 0.3 mm in each was four thousandths of a millimetre of filament.
  constexpr double least_mm3 = 0.01, simplified = 0.9;
  WallSettings settings;
  settings.wall_line_width_0 = settings.wall_line_width_x = 0.45_mm;
  int parts_with_tips = 0, parts_without = 0;
  for (double radius = 1350; radius <= 2000; radius += 25) {
    CAPTURE(radius);
    constexpr double half = 1320;
    constexpr int corners = 14;
    const double turn = std::asin(half / radius);
    Region horns{{{rounded(2 * half), 4000}, {0, 4000}}, {}};
    for (int i = 0; i <= corners; ++i) {
      const double a = turn * (2.0 * i / corners - 1);
      horns.outer.push_back({rounded(half + radius * std::sin(a)), rounded(radius * (std::cos(a) - std::cos(turn)))});
    }
    const auto walls = built({horns}, settings);
    REQUIRE(std::any_of(walls.beads.begin(), walls.beads.end(), [](const Bead& b) { return b.closed; }));
    int tips = 0;
    for (const Bead& bead : walls.beads) {
      if (bead.closed || bead.inset > 0) continue;
      ++tips;
      CHECK(volume_mm3(bead, 200) >= simplified * least_mm3);
    }
    ++(tips > 0 ? parts_with_tips : parts_without);
  }
  CHECK(parts_with_tips > 3);  // longer ones are worth it
  CHECK(parts_without > 3);
}
