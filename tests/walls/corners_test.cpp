// SPDX-License-Identifier: GPL-3.0-or-later
#include "band.h"
#include "walls/shapes.h"
#include "walls/walls.h"

#include <algorithm>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

namespace {

constexpr Um usual_wall = 0.45_mm;

WallLayer walls_with(double corner_width, const Region& region, Um outer = usual_wall) {
  WallSettings settings = by_volume();
  settings.wall_line_width_0 = outer;
  settings.wall_line_width_x = 0.45_mm;
  settings.wall_corner_width = corner_width;
  return built({region}, settings);
}

/// The least width of the outermost wall near a corner at 0.
Um narrowest(const WallLayer& walls) {
  Um least = 10_mm;
  for (const Bead& bead : walls.beads)
    if (bead.inset == 0)
      for (const Junction& j : bead.path)
        if (distance(j.at, {0, 0}) < 2_mm) least = std::min(least, j.width);
  return least;
}

bool is_covered(const WallLayer& walls, Point p) {
  return std::any_of(walls.beads.begin(), walls.beads.end(), [&](const Bead& b) { return covers(b, p.x, p.y); });
}

/// A part with a corner of that angle at 0.
Region corner_of(double degrees, Um size) {
  const double half = degrees / 2 * std::numbers::pi / 180;
  const auto at = [&](double along, double aside) { return Point{rounded(along), rounded(aside)}; };
  return {{{0, 0},
           at(size * std::cos(half), -size * std::sin(half)),
           at(1.5 * size, -0.2 * size),
           at(1.5 * size, 0.2 * size),
           at(size * std::cos(half), size * std::sin(half))},
          {}};
}

}  // namespace

TEST_CASE("walls: in a sharp corner walls get narrower and reach further, and nothing else changes", "[walls]") {
  const Region square = rectangle(0, 0, 10_mm, 10_mm);
  const auto sharp = walls_with(75, square), round = walls_with(100, square);
  CHECK(narrowest(round) == Approx(450 - 43).margin(2));
  CHECK(narrowest(sharp) == Approx(0.75 * (450 - 43)).margin(3));
  // 0.06 mm from both sides only the narrow bend is there; between the bends of the first two walls, too.
  CHECK_FALSE(is_covered(round, {50, 50}));
  CHECK(is_covered(sharp, {50, 50}));
  CHECK_FALSE(is_covered(round, {460, 460}));
  CHECK(is_covered(sharp, {460, 460}));
  // Side by side away from corners they are what they are, and all over the part as much is laid.
  for (const auto* walls : {&sharp, &round})
    for (const Bead& bead : walls->beads)
      for (const Junction& j : bead.path)
        if (j.at.x > 2_mm && j.at.x < 8_mm) CHECK(j.width == Approx(450 - 43).margin(2));
  CHECK(area_mm2(sharp.inside) == Approx(area_mm2(round.inside)).epsilon(1e-4));
  CHECK(bead_area_mm2(sharp) == Approx(bead_area_mm2(round)).epsilon(0.003));
}

TEST_CASE("walls: bends take up to 100°, and no wall gets narrower than min_output_width", "[walls]") {
  const double wide = 450 - 43;
  for (const double degrees : {60.0, 75.0, 90.0, 98.0}) {
    CAPTURE(degrees);
    CHECK(narrowest(walls_with(75, corner_of(degrees, 10_mm))) < 0.8 * wide);
  }
  for (const double degrees : {103.0, 120.0, 150.0}) {
    CAPTURE(degrees);
    CHECK(narrowest(walls_with(75, corner_of(degrees, 10_mm))) > 0.97 * wide);
  }
  CHECK(narrowest(walls_with(75, rectangle(0, 0, 10_mm, 10_mm), 0.3_mm)) == Approx(300 - 43).margin(2));
}

TEST_CASE("walls: a wall in a corner keeps to the outline and leaves less bare behind it", "[walls]") {
  // Less than with bends as wide as walls; the corner's tip apart, which no round bead reaches.
  const Region square = rectangle(0, 0, 10_mm, 10_mm);
  const auto bare = [](const WallLayer& walls) {
    int n = 0;
    for (Um x = 11; x < 1_mm; x += 7)
      for (Um y = 13; y < 1_mm; y += 7) n += x + y > 150 && !is_covered(walls, {x, y});
    return n;
  };
  const auto walls = walls_with(75, square);
  CHECK(bare(walls) < 0.65 * bare(walls_with(100, square)));
  for (Um t = 5; t < 10_mm; t += 11) {
    CHECK_FALSE(is_covered(walls, {t, -11}));
    CHECK_FALSE(is_covered(walls, {-11, t}));
  }
}

TEST_CASE("walls: where a thin part bends all beads keep their widths", "[walls]") {
  // Five beads. Angles between arms: a right one, a blunt one, and one of each hand.
  for (const double degrees : {90.0, 120.0, 150.0, -110.0}) {
    const double turn = degrees * std::numbers::pi / 180, half = 980, far = 10'000;
    const auto on = [&](double along, double aside) {  // the second arm
      const double side = turn > 0 ? aside : -aside;
      return Point{rounded(along * std::cos(turn) - side * std::sin(turn)),
                   rounded(along * std::sin(turn) + side * std::cos(turn))};
    };
    const double at = half / std::tan(std::abs(turn) / 2), sign = turn > 0 ? 1 : -1;
    Ring ring{{rounded(far), rounded(-sign * half)},
              {rounded(far), rounded(sign * half)},
              {rounded(at), rounded(sign * half)},
              on(far, -half),
              on(far, half),
              {rounded(-at), rounded(-sign * half)}};
    if (sign < 0) std::reverse(ring.begin(), ring.end());
    const WallLayer walls = walls_with(100, {ring, {}});
    CAPTURE(degrees);
    int middles = 0, inner = 0;
    for (const Bead& bead : walls.beads) {
      if (bead.inset == 0) continue;
      Um least = 10_mm, most = 0, bends = 0;
      for (const Junction& j : bead.path)
        if (distance(j.at, {0, 0}) < 5_mm) least = std::min(least, j.width), most = std::max(most, j.width), ++bends;
      CHECK(most < 1.1 * least);
      CHECK(bends <= (bead.closed ? 4 : 5));
      (bead.closed ? inner : middles) += 1;
    }
    CHECK(middles == 1);
    CHECK(inner == 1);
    // Nothing is bare but beside the outer wall, which goes round.
    CHECK(is_covered(walls, {0, 0}));
    CHECK(is_covered(walls, {rounded(-0.4 * at), rounded(-sign * 400)}));
  }
}
