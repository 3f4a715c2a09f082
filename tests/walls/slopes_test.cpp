// SPDX-License-Identifier: GPL-3.0-or-later
#include "shapes.h"

#include <algorithm>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

namespace {

/// Two walls of 0.45 mm: the middle of an outer wall above lies on them up to 0.61 mm inside the outline.
WallSettings two_walls() {
  WallSettings settings = by_volume();
  settings.wall_line_count = 2;
  settings.wall_line_width_0 = settings.wall_line_width_x = 0.45_mm;
  return settings;
}

constexpr Um box_width = 20_mm;

/// Walls around the box of a layer above which the outline stands further in by so much on all sides.
std::size_t beads_below(Um step, bool on_slopes, Um wide = box_width) {
  WallSettings settings = two_walls();
  settings.wall_extra_on_slopes = on_slopes;
  const Regions here{rectangle(0, 0, wide, wide)}, above{rectangle(step, step, wide - step, wide - step)};
  const SlicedLayer layer = layer_of(here);
  return walls::build(settings, {.layer = layer, .index = 1, .nozzle_diameter = usual_nozzle, .above = &above})
      .beads.size();
}

}  // namespace

TEST_CASE("walls: wall_extra_on_slopes adds the walls that the outer walls above need to lie on", "[walls]") {
  CHECK(beads_below(1.2_mm, false) == 2);
  CHECK(beads_below(0, true) == 2);
  CHECK(beads_below(0.3_mm, true) == 2);  // lies on the walls that are there
  CHECK(beads_below(0.8_mm, true) == 3);
  CHECK(beads_below(1.2_mm, true) == 4);
  CHECK(beads_below(3_mm, true) == 2);  // a top surface, with skin below what stands on it
}

TEST_CASE("walls: wall_extra_on_slopes leaves a part alone that only a small part of the outline above needs walls of",
          "[walls]") {
  WallSettings settings = two_walls();
  settings.wall_extra_on_slopes = true;
  // One side of four steps in: a quarter of the outline.
  const Regions here{rectangle(0, 0, 20_mm, 20_mm)}, above{rectangle(1.2_mm, 0, 20_mm, 20_mm)};
  const SlicedLayer layer = layer_of(here);
  const auto built =
      walls::build(settings, {.layer = layer, .index = 1, .nozzle_diameter = usual_nozzle, .above = &above});
  CHECK(built.beads.size() == 2);
  // Of two parts only the one that the slope is above gets more.
  const Regions two{rectangle(0, 0, 10_mm, 10_mm), rectangle(20_mm, 0, 30_mm, 10_mm)},
      over{rectangle(0, 0, 10_mm, 10_mm), rectangle(20.8_mm, 0.8_mm, 29.2_mm, 9.2_mm)};
  const SlicedLayer both = layer_of(two);
  const auto apart =
      walls::build(settings, {.layer = both, .index = 1, .nozzle_diameter = usual_nozzle, .above = &over});
  const auto of_part = [&](std::uint32_t part) {
    return std::count_if(apart.beads.begin(), apart.beads.end(), [&](const Bead& b) { return b.part == part; });
  };
  CHECK(of_part(0) == 2);
  CHECK(of_part(1) == 3);
}
