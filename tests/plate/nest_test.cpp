// SPDX-License-Identifier: GPL-3.0-or-later
#include "plate/nest.h"

#include "cuboid.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "plate/silhouette.h"

#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::literals;
using namespace weft::plate;

namespace {

Regions rectangle(Um x, Um y) {
  return {{{{-x / 2, -y / 2}, {x / 2, -y / 2}, {x / 2, y / 2}, {-x / 2, y / 2}}, {}}};
}
/// An L of arms as thick as a third of the side.
Regions angle(Um side) {
  const Um h = side / 2, t = side / 3;
  return {{{{-h, -h}, {h, -h}, {h, -h + t}, {-h + t, -h + t}, {-h + t, h}, {-h, h}}, {}}};
}
Regions disc(Um radius) {
  Region out;
  for (int i = 0; i < 48; ++i)
    out.outer.push_back(
        {rounded(radius * std::cos(i * 6.283185307 / 48)), rounded(radius * std::sin(i * 6.283185307 / 48))});
  return {out};
}
/// By quarters, counter-clockwise.
Regions turned(Regions outline, int quarters) {
  for (; quarters > 0; --quarters)
    for (auto& region : outline)
      for (Point& p : region.outer) p = {-p.y, p.x};
  return outline;
}
Ring square_bed(Um side) {
  return {{0, 0}, {side, 0}, {side, side}, {0, side}};
}

/// Every two are as far apart as they are to be, and all lie on the surface and off what is kept out.
void check_apart(const std::vector<NestKind>& kinds, const NestBed& bed,
                 const std::vector<std::vector<Nested>>& places) {
  std::vector<Regions> standing;
  for (std::size_t k = 0; k < kinds.size(); ++k)
    for (const auto& [at, turn] : places[k]) standing.push_back(moved(kinds[k].outlines[turn], at));
  constexpr Um rounding = 5;
  for (std::size_t i = 0; i < standing.size(); ++i) {
    CHECK(geometry::subtract(
              geometry::offset(standing[i], {.by = bed.beside - rounding, .corner = geometry::Corner::round}),
              {{bed.surface, {}}})
              .empty());
    for (const auto& ring : bed.keep_out)
      CHECK(geometry::intersect(
                geometry::offset(standing[i], {.by = bed.beside - rounding, .corner = geometry::Corner::round}),
                {{ring, {}}})
                .empty());
    const auto wide = geometry::offset(
        standing[i], {.by = bed.spacing + 2 * bed.beside - rounding, .corner = geometry::Corner::round});
    for (std::size_t k = 0; k < i; ++k) CHECK(geometry::intersect(wide, standing[k]).empty());
  }
}

}  // namespace

TEST_CASE("nest: what is placed is apart, on the surface and off what is kept out") {
  std::mt19937 random(2);
  const auto number = [&](int least, int most) {
    return least + static_cast<int>(random() % static_cast<unsigned>(most - least + 1));
  };
  std::size_t placed = 0;
  for (int run = 0; run < 12; ++run) {
    std::vector<NestKind> kinds;
    for (int i = number(1, 4); i > 0; --i) {
      const int which = number(0, 2);
      const auto outline = which == 0   ? rectangle(number(8, 30) * 1_mm, number(8, 30) * 1_mm)
                           : which == 1 ? angle(number(12, 40) * 1_mm)
                                        : disc(number(5, 15) * 1_mm);
      kinds.push_back({{outline, turned(outline, 1), turned(outline, 2)}, static_cast<std::size_t>(number(1, 5))});
    }
    NestBed bed{square_bed(200_mm), {}, {100_mm, 100_mm}, number(1, 6) * 1_mm, number(0, 3) * 1_mm};
    if (run % 2 == 0) bed.keep_out.push_back({{90_mm, 90_mm}, {120_mm, 90_mm}, {120_mm, 130_mm}, {90_mm, 130_mm}});
    if (run % 3 == 0)
      bed.surface = {{0, 0}, {200_mm, 0}, {200_mm, 60_mm}, {120_mm, 60_mm}, {120_mm, 200_mm}, {0, 200_mm}};
    const auto places = nest(kinds, bed);
    check_apart(kinds, bed, places);
    for (const auto& kind : places) placed += kind.size();
  }
  CHECK(placed > 40);
}

TEST_CASE("nest: as many as there is room for, and more than in rows of boxes") {
  const NestBed bed{square_bed(200_mm), {}, {100_mm, 100_mm}, 2_mm, 0};
  const auto count = [&](const Regions& outline) {
    const std::vector<NestKind> kinds{{{outline}, 0}};
    const auto places = nest(kinds, bed);
    check_apart(kinds, bed, places);
    return places.front().size();
  };
  CHECK(count(rectangle(38_mm, 38_mm)) == 25);  // five of 38 and 2 between them are 198
  const auto rows = [&](Um side) {
    const auto n = static_cast<std::size_t>((200_mm + 2_mm) / (side + 2_mm));
    return n * n;
  };
  CHECK(static_cast<double>(count(angle(40_mm))) >= 1.15 * static_cast<double>(rows(40_mm)));
}

TEST_CASE("nest: boxes stand in rows, and no fewer than rows hold") {
  const NestBed bed{{{0, 0}, {250_mm, 0}, {250_mm, 210_mm}, {0, 210_mm}}, {}, {125_mm, 105_mm}, 6_mm, 0};
  for (const Um side : {20_mm, 33_mm, 48_mm}) {
    const std::vector<NestKind> kinds{{{rectangle(side, side)}, 0}};
    const auto places = nest(kinds, bed);
    check_apart(kinds, bed, places);
    const auto in_row = [&](Um length) { return static_cast<std::size_t>((length + 6_mm) / (side + 6_mm)); };
    INFO("side " << side);
    CHECK(places.front().size() == in_row(250_mm) * in_row(210_mm));
  }
}

TEST_CASE("nest: what has room as it lies is not turned, and what has none is") {
  const NestBed bed{{{0, 0}, {100_mm, 0}, {100_mm, 30_mm}, {0, 30_mm}}, {}, {50_mm, 15_mm}, 1_mm, 0};
  const auto upright = rectangle(20_mm, 90_mm), small = rectangle(20_mm, 20_mm);
  const std::vector<NestKind> kinds{{{upright, turned(upright, 1)}, 1}};
  const auto lying = nest(kinds, bed);
  REQUIRE(lying.front().size() == 1);
  CHECK(lying.front().front().turn == 1);
  const std::vector<NestKind> fits{{{small, turned(small, 1)}, 2}};
  const auto standing = nest(fits, bed);
  for (const auto& [at, turn] : standing.front()) CHECK(turn == 0);
}

TEST_CASE("nest: what is higher than the bar stands one behind the other across it, what is lower anywhere") {
  const std::vector<NestKind> kinds{{{rectangle(20000, 20000)}, 4, true}, {{rectangle(20000, 20000)}, 6, false}};
  for (const Bar bar : {Bar::along_x, Bar::along_y}) {
    NestBed bed{square_bed(200'000), {}, {100'000, 100'000}, 10'000, 0, bar};
    const auto places = nest(kinds, bed);
    REQUIRE(places[0].size() == 4);
    REQUIRE(places[1].size() == 6);
    check_apart(kinds, bed, places);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const Point by = places[0][i].at - places[0][k].at;
        CHECK(std::abs(bar == Bar::along_x ? by.y : by.x) >= 30'000 - 5);
      }
    bed.bar = Bar::none;
    CHECK(nest(kinds, bed)[0].size() == 4);
  }
  const NestBed bed{square_bed(200'000), {}, {100'000, 100'000}, 10'000, 0, Bar::along_x};
  CHECK(nest(std::vector<NestKind>{{{rectangle(20000, 20000)}, 0, true}}, bed)[0].size() == 7);  // 7 · 20 + 6 · 10
}

TEST_CASE("nest: triangles stand in pairs, and as densely as a lattice of them is") {
  const NestBed bed{square_bed(200_mm), {}, {100_mm, 100_mm}, 1_mm, 0};
  const Regions one{{{{-10_mm, -10_mm}, {10_mm, -10_mm}, {-10_mm, 10_mm}}, {}}};
  const std::vector<NestKind> kinds{{{one, turned(one, 1), turned(one, 2), turned(one, 3)}, 0}};
  const auto places = nest(kinds, bed);
  check_apart(kinds, bed, places);
  CHECK(places.front().size() >= 150);  // rows of boxes have 81; 1 mm apart, each takes 240 mm²
}

TEST_CASE("nest: pairs that are turned lie in each other") {
  const NestBed bed{square_bed(200_mm), {}, {100_mm, 100_mm}, 2_mm, 0};
  const auto one = angle(60_mm);
  const std::vector<NestKind> kept{{{one}, 0}}, may_turn{{{one, turned(one, 1), turned(one, 2), turned(one, 3)}, 0}};
  const auto places = nest(may_turn, bed);
  check_apart(may_turn, bed, places);
  CHECK(places.front().size() > nest(kept, bed).front().size());
}

TEST_CASE("nest: the silhouette of a mesh is what its triangles cover") {
  Mesh mesh;  // a table: a plate on a foot, upside down parts and all
  const auto add = [&](Um x0, Um y0, Um x1, Um y1, Um z0, Um z1) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Um z : {z0, z1})
      for (const Point p : {Point{x0, y0}, Point{x1, y0}, Point{x1, y1}, Point{x0, y1}})
        mesh.vertices.push_back({p.x, p.y, z});
    for (const auto& f : cuboid_faces)
      mesh.triangles.push_back({first + static_cast<std::uint32_t>(f[0]), first + static_cast<std::uint32_t>(f[1]),
                                first + static_cast<std::uint32_t>(f[2])});
  };
  add(0, 0, 10'000, 10'000, 0, 5'000);
  add(4'000, -5'000, 6'000, 20'000, 5'000, 6'000);
  add(30'000, 0, 31'000, 1'000, 0, 1'000);
  const auto outline = silhouette_of({&mesh, 1});
  CHECK(area_mm2(outline) == Approx(100 + 2 * 5 + 2 * 10 + 1));
  CHECK(outline.size() == 2);
}
