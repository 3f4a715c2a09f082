// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/footprints.h"

#include "rectangle.h"
#include "walls/keep_volume.h"
#include "walls/move_aside.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::walls;

namespace {

constexpr Um nominal = 400, narrowest = 200;

/// A part of 10 x 10 mm.
const Region part = test::rectangle(0, 0, 10_mm, 10_mm);

/// The wall of the part, so far from its outline and so wide.
Bead wall(Um inset, Um width) {
  Bead out;
  out.closed = true;
  for (const Point p : test::rectangle(inset, inset, 10_mm - inset, 10_mm - inset).outer)
    out.path.push_back({p, width});
  return out;
}

bool kept(Beads& beads, double least_mm2) {
  Room room(part, {0, 0});
  return Footprints(room, {0, 0}, nominal, narrowest, beads).keep(least_mm2, beads);
}

}  // namespace

TEST_CASE("footprints: a loop that reaches over the outline by more than 10 µm moves inwards and stays as wide",
          "[walls]") {
  Beads beads{wall(200, 440)};  // over it by 20 µm
  CHECK(kept(beads, 0));
  for (const Junction& j : beads.front().path) {
    CHECK(j.width == 440);
    for (const Um off : {j.at.x, 10_mm - j.at.x, j.at.y, 10_mm - j.at.y}) CHECK(off >= 440 / 2 - 10);
  }
}

TEST_CASE("footprints: where the end of a wall reaches over the outline, what is further off than it is wide stays",
          "[walls]") {
  // Its whole side gave way, and left a wedge of 4 mm bare.
  Beads beads{wall(200, nominal)};
  auto& path = beads.front().path;
  path.insert(path.begin() + 1,
              {{{5'000, 200}, nominal}, {{5'100, 200}, 460}, {{5'300, 200}, 460}, {{5'400, 200}, nominal}});
  CHECK(kept(beads, 0));
  int moved = 0;
  for (const Junction& j : beads.front().path) {
    const bool stays = j.at.x == 200 || j.at.x == 9'800 || j.at.y == 200 || j.at.y == 9'800;
    moved += stays ? 0 : 1;
    CAPTURE(j.at.x, j.at.y);
    CHECK((stays || (j.at.x >= 5'000 - nominal && j.at.x <= 5'400 + nominal)));
  }
  CHECK(moved >= 2);
  // … and between the junctions that stay and those that move there is a bead's width.
  for (std::size_t k = 0; k < path.size(); ++k) {
    const Point a = path[k].at, b = path[(k + 1) % path.size()].at;
    if (distance(a, b) > 1'000) CHECK((a.x == b.x || a.y == b.y));
  }
}

TEST_CASE("footprints: a ramp of width is looked at although the width in its middle is the nominal one", "[walls]") {
  Beads beads{wall(185, nominal)};
  Um wider = 40;  // … everywhere: they reach over the outline by 15 µm
  for (Junction& j : beads.front().path) j.width += wider, wider = -wider;
  CHECK(kept(beads, 0));
}

TEST_CASE("footprints: what reaches over the outline by less stays", "[walls]") {
  Beads beads{wall(200, 416)};
  const Beads before = beads;
  CHECK_FALSE(kept(beads, 0));
  CHECK(beads == before);
}

TEST_CASE("footprints: pieces of a loop with the nominal width are not looked at", "[walls]") {
  Beads beads{wall(180, nominal)};
  CHECK_FALSE(kept(beads, 0));
}

TEST_CASE("footprints: a single bead gets narrower where it reaches over, on either side alike", "[walls]") {
  Bead bead;
  bead.path = {{{1_mm, 240}, 490}, {{2_mm, 240}, 490}, {{4_mm, 300}, 500}, {{6_mm, 300}, 500}};
  Beads beads{bead};
  const Region strip = test::rectangle(0, 0, 10_mm, 600);  // room for 480 there, then for 600
  Room room(strip, {0, 0});
  CHECK_FALSE(Footprints(room, {0, 0}, nominal, narrowest, beads).keep(0, beads));  // over it by 5 µm
  beads.front().path[0].width = beads.front().path[1].width = 520;
  CHECK(Footprints(room, {0, 0}, nominal, narrowest, beads).keep(0, beads));
  const auto& path = beads.front().path;
  CHECK(path[0].width + path[1].width <= 2 * (480 + 20));
  CHECK(path[0].at == bead.path[0].at);
  CHECK(path.back() == bead.path.back());
}

TEST_CASE("footprints: the part's volume comes first", "[walls]") {
  Beads beads{wall(200, 440)};
  const double laid = volume_mm3(beads.front(), 1_mm);
  const Beads before = beads;
  CHECK_FALSE(kept(beads, laid));  // a loop further in is shorter
  CHECK(beads == before);
}

TEST_CASE("footprints: a flow-compensated bead gives way by its flow", "[walls]") {
  Bead bead;
  bead.path = {{{1_mm, 50}, 200, 0.8F}, {{4_mm, 50}, 200, 0.8F}};  // 160 µm where there is room for 100
  Beads beads{bead};
  const Region rib = test::rectangle(0, 0, 5_mm, 100);
  Room room(rib, {0, 0});
  CHECK(Footprints(room, {0, 0}, nominal, narrowest, beads).keep(0, beads));
  for (const Junction& j : beads.front().path) {
    CHECK(j.width == 200);
    CHECK(j.flow * 200 <= 100 + 2 * 10);
    CHECK(j.flow * 200 >= 100);
  }
}

TEST_CASE("footprints: a bead that would get narrower than any is planned gives way by its flow", "[walls]") {
  Bead bead;
  bead.path = {{{1_mm, 75}, 210}, {{4_mm, 75}, 210}};  // room for 150
  Beads beads{bead};
  const Region rib = test::rectangle(0, 0, 5_mm, 150);
  Room room(rib, {0, 0});
  CHECK(Footprints(room, {0, 0}, nominal, narrowest, beads).keep(0, beads));
  for (const Junction& j : beads.front().path) {
    CHECK(j.width == narrowest);
    CHECK(j.flow * narrowest == Approx(150 + 2 * 8).margin(1));
  }
}

TEST_CASE("walls: junctions of a loop move between their sides, to its left", "[walls]") {
  Bead bead = wall(200, nominal);
  const std::vector<double> by(bead.path.size(), 10);
  move_left(bead, by);
  // Counter-clockwise: the part is on the left. 10 µm along the diagonal are 7 along each side.
  for (const Junction& j : bead.path)
    for (const Um off : {std::min(j.at.x, 10_mm - j.at.x), std::min(j.at.y, 10_mm - j.at.y)}) CHECK(off == 207);
}

TEST_CASE("keep_volume: beads are scaled until what lacks is within 0.3 %", "[walls]") {
  Beads beads{wall(200, nominal)};
  const double laid = volume_mm3(beads.front(), 1_mm);
  CHECK(keep_volume(1.002 * laid, 900, false, beads) == 1);
  CHECK(beads.front().path.front().width == nominal);
  const double wider = keep_volume(1.04 * laid, 900, false, beads);
  CHECK(wider == Approx(1.037).margin(0.002));
  CHECK(volume_mm3(beads.front(), 1_mm) == Approx(1.04 * laid).epsilon(0.004));
}

TEST_CASE("keep_volume: a single bead has the outline on both sides and gains 4 µm at most", "[walls]") {
  Bead bead;
  bead.path = {{{0, 0}, nominal}, {{5_mm, 0}, nominal}};
  Beads beads{bead};
  keep_volume(1.5 * volume_mm3(bead, 1_mm), 900, false, beads);
  for (const Junction& j : beads.front().path) CHECK(j.width == nominal + 4);
}
