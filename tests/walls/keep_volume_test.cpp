// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/keep_volume.h"

#include "rectangle.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::walls;

namespace {

constexpr Um nominal = 400;

/// The wall of a part of 10 x 10 mm, so far from its outline and so wide.
Bead wall(Um inset, Um width) {
  Bead out;
  out.closed = true;
  for (const Point p : test::rectangle(inset, inset, 10_mm - inset, 10_mm - inset).outer)
    out.path.push_back({p, width});
  return out;
}

}  // namespace

TEST_CASE("keep_volume: beads are scaled until what lacks is within 0.3 %", "[walls]") {
  Beads beads{wall(200, nominal)};
  const double laid = volume_mm3(beads.front(), 1_mm);
  keep_volume(1.002 * laid, 900, false, beads);
  CHECK(beads.front().path.front().width == nominal);
  keep_volume(1.04 * laid, 900, false, beads);
  CHECK(volume_mm3(beads.front(), 1_mm) == Approx(1.04 * laid).epsilon(0.004));
}

TEST_CASE("keep_volume: a single bead has the outline on both sides and gains 4 µm at most", "[walls]") {
  Bead bead;
  bead.path = {{{0, 0}, nominal}, {{5_mm, 0}, nominal}};
  Beads beads{bead};
  keep_volume(1.5 * volume_mm3(bead, 1_mm), 900, false, beads);
  for (const Junction& j : beads.front().path) CHECK(j.width == nominal + 4);
}
