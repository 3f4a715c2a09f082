// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/small_areas.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::infill;

TEST_CASE("small areas: a line loses the plastic that a quarter of a millimetre of it holds") {
  Beads beads(3);
  beads[0].role = beads[1].role = Role::solid_infill, beads[2].role = Role::gap_fill;
  beads[0].path = {{{0, 0}, 400, 1.F}, {{1'000, 0}, 400, 1.F}};
  // Two lines and the turn between them.
  beads[1].path = {{{0, 400}, 400, 1.F}, {{5'000, 400}, 400, 1.F}, {{5'000, 800}, 400, 1.F}, {{0, 800}, 400, 1.F}};
  beads[2].path = beads[0].path;
  thin_short_lines(250, 0, 0, beads);
  CHECK(beads[0].path[0].flow == Approx(0.8));
  CHECK(beads[0].path[1].flow == Approx(0.8));
  for (const Junction& j : beads[1].path) CHECK(j.flow == Approx(5 / 5.25));
  CHECK(beads[2].path[0].flow == 1.F);
}
