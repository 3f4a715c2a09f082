// SPDX-License-Identifier: GPL-3.0-or-later
#include "overhangs/overhangs.h"

#include "model/flow.h"
#include "picture.h"
#include "rectangle.h"

#include <array>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

namespace {

constexpr Um band = 400, height = 200;

Extrude wall(std::vector<Point> points, bool closed = false, Role role = Role::outer_wall) {
  Extrude bead{.path = {}, .role = role, .height = height};
  for (const Point p : points) bead.path.push_back({p, band, 1.F});
  if (closed) bead.path.push_back(bead.path.front());
  return bead;
}

std::vector<Extrude> marked(std::vector<Extrude> beads, const Regions& over_air) {
  LayerPlan layer{.z = 1000, .height = height};
  for (auto& bead : beads) layer.steps.emplace_back(std::move(bead));
  const std::array strands{overhangs::Strand{400, 1}};
  tests::look_at(over_air);
  overhangs::mark(strands, over_air, layer);
  std::vector<Extrude> out;
  for (const auto& step : layer.steps) out.push_back(std::get<Extrude>(step));
  return out;
}

double length_of(const Extrude& bead) {
  double mm = 0;
  for (std::size_t i = 1; i < bead.path.size(); ++i) mm += distance(bead.path[i - 1].at, bead.path[i].at) / 1000;
  return mm;
}

/// Pieces lead on from each other, from the first junction to the last, and are as long as the whole.
void check_whole(const Extrude& bead, const std::vector<Extrude>& pieces) {
  REQUIRE(!pieces.empty());
  CHECK(pieces.front().path.front().at == bead.path.front().at);
  CHECK(pieces.back().path.back().at == bead.path.back().at);
  double mm = 0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    REQUIRE(pieces[i].path.size() > 1);
    if (i > 0) CHECK(pieces[i].path.front().at == pieces[i - 1].path.back().at);
    mm += length_of(pieces[i]);
  }
  CHECK(mm == Approx(length_of(bead)).margin(0.005));
}

bool is_strand(const Extrude& piece) {
  const auto flow = static_cast<float>(flow::bridge_flow(400, height));
  return std::all_of(piece.path.begin(), piece.path.end(),
                     [&](const Junction& j) { return j.width == 400 && j.flow == flow; });
}

}  // namespace

TEST_CASE("overhangs: a fan of slopes gets the quarter of its width that hangs", "[overhangs]") {
  // The wall's outer edge lies on the outline; below it ends h·tan φ further in.
  const double from_upright = GENERATE(0.0, 5.0, 20.0, 35.0, 50.0, 60.0, 70.0, 85.0);
  CAPTURE(from_upright);
  const double hangs = height * std::tan(from_upright * std::numbers::pi / 180);
  const Um edge = 20000, below = edge - rounded(hangs);
  const Extrude bead = wall({{edge - band / 2, 0}, {edge - band / 2, 30000}});
  const auto pieces = marked({bead}, below < edge ? Regions{rectangle(below, -1000, edge, 31000)} : Regions{});
  check_whole(bead, pieces);
  REQUIRE(pieces.size() == 1);
  const double share = std::min(1.0, hangs / band);
  const int quarters = share < 0.1 ? 0 : static_cast<int>(std::min(4.0, std::ceil(share * 4)));
  CHECK(pieces[0].air_quarters == quarters);
  CHECK((pieces[0].role == Role::overhang_wall) == (share > 0.95));
  CHECK(pieces[0].path[0].flow == 1.F);  // nothing holds its ends
}

TEST_CASE("overhangs: a lintel is a free strand between what holds it, and nothing else of the loop changes",
          "[overhangs]") {
  // A window from x = 10 to 19 mm; the loop runs over it and back beside it, over what is there.
  const Regions window{rectangle(10000, -1000, 19000, 2000)};
  const Extrude loop = wall({{0, 0}, {30000, 0}, {30000, 10000}, {0, 10000}}, true);
  const auto pieces = marked({loop}, window);
  check_whole(loop, pieces);
  REQUIRE(pieces.size() == 3);
  CHECK(pieces[0].air_quarters == 0);
  CHECK(pieces[0].role == Role::outer_wall);
  CHECK(pieces[1].role == Role::overhang_wall);
  CHECK(pieces[1].air_quarters == 4);
  CHECK(is_strand(pieces[1]));
  CHECK(length_of(pieces[1]) == Approx(9).margin(0.05));
  CHECK(pieces[2].role == Role::outer_wall);
  CHECK(pieces[2].path.back() == loop.path.back());
}

TEST_CASE("overhangs: a seam in the middle of a lintel does not take its end from it", "[overhangs]") {
  const Regions window{rectangle(10000, -1000, 19000, 2000)};
  const Extrude loop = wall({{15000, 0}, {30000, 0}, {30000, 10000}, {0, 10000}, {0, 0}}, true);
  const auto pieces = marked({loop}, window);
  check_whole(loop, pieces);
  REQUIRE(pieces.size() == 3);
  CHECK(is_strand(pieces[0]));
  CHECK(!is_strand(pieces[1]));
  CHECK(is_strand(pieces[2]));
}

TEST_CASE("overhangs: the rest of a loop between a corner and its seam is no piece of its own", "[overhangs]") {
  for (const Um rest : {10, 30}) {
    const Extrude loop = wall({{0, rest}, {0, 10000}, {30000, 10000}, {30000, 0}, {0, 0}}, true);
    const auto pieces = marked({loop}, {rectangle(-1000, -1000, 31000, 0)});
    check_whole(loop, pieces);
    CHECK(pieces.size() > 1);
    for (const Extrude& piece : pieces) CHECK(length_of(piece) > 0.05);
  }
}

TEST_CASE("overhangs: what hangs is told as well where the seam is near to it", "[overhangs]") {
  const Regions window{rectangle(10000, -1000, 11100, 2000)};
  for (const bool behind : {false, true}) {  // the loop begins on what is left to either side of it
    const Point seam{behind ? 11700 : 9400, 0};
    const Extrude loop = wall({seam, {30000, 0}, {30000, 10000}, {0, 10000}, {0, 0}}, true);
    const auto pieces = marked({loop}, window);
    check_whole(loop, pieces);
    REQUIRE(pieces.size() == 3);
    CHECK(pieces[0].air_quarters == 0);
    CHECK(pieces[1].role == Role::overhang_wall);
    CHECK(length_of(pieces[1]) == Approx(1.1).margin(0.06));
    CHECK(pieces[2].air_quarters == 0);
  }
}

TEST_CASE("overhangs: a shelf is held at one end, and what turns over air at none: both stay walls", "[overhangs]") {
  const Regions beyond{rectangle(10000, -5000, 40000, 15000)};
  SECTION("an open wall that ends in the air") {
    const Extrude bead = wall({{0, 0}, {20000, 0}});
    const auto pieces = marked({bead}, beyond);
    check_whole(bead, pieces);
    REQUIRE(pieces.size() == 2);
    CHECK(pieces[1].role == Role::overhang_wall);
    CHECK(!is_strand(pieces[1]));
  }
  SECTION("a loop round a shelf") {
    const Extrude bead = wall({{0, 0}, {20000, 0}, {20000, 10000}, {0, 10000}}, true);
    const auto pieces = marked({bead}, beyond);
    check_whole(bead, pieces);
    REQUIRE(pieces.size() == 3);
    CHECK(pieces[1].role == Role::overhang_wall);
    CHECK(!is_strand(pieces[1]));
  }
  SECTION("a loop that hangs all round") {
    const Extrude bead = wall({{12000, 0}, {20000, 0}, {20000, 10000}, {12000, 10000}}, true);
    const auto pieces = marked({bead}, beyond);
    REQUIRE(pieces.size() == 1);
    CHECK(pieces[0].role == Role::overhang_wall);
    CHECK(!is_strand(pieces[0]));
  }
}

TEST_CASE("overhangs: skin over air is told apart and keeps its width, held at one end or at both", "[overhangs]") {
  const Regions ledge{rectangle(10000, -5000, 20000, 15000)};
  const Extrude lines = wall({{0, 0}, {20000, 0}, {20000, 400}, {0, 400}}, false, Role::solid_infill);
  const auto pieces = marked({lines}, ledge);
  check_whole(lines, pieces);
  REQUIRE(pieces.size() == 3);
  CHECK(pieces[1].role == Role::overhang_skin);
  CHECK(length_of(pieces[1]) == Approx(20.4).margin(0.8));  // there and back, looked at every 0.4 mm
  for (const std::size_t held : {0U, 2U}) CHECK(pieces[held].role == Role::solid_infill);

  const auto over_slit = marked({lines}, {rectangle(5000, -5000, 8000, 15000)});
  REQUIRE(over_slit.size() == 5);
  for (const auto* all : {&pieces, &over_slit})
    for (const Extrude& piece : *all)
      for (const Junction& j : piece.path) CHECK((j.width == band && j.flow == 1.F));

  const auto top = marked({wall({{0, 0}, {20000, 0}}, false, Role::top_skin)}, ledge);
  REQUIRE(top.size() == 2);
  CHECK(top[1].role == Role::top_skin);
  CHECK(top[1].air_quarters == 4);
}

TEST_CASE("overhangs: short stretches that follow each other are one, a single one is none", "[overhangs]") {
  const auto comb = [](int teeth) {
    Regions air;
    for (Um x = 10000; x < 10000 + teeth * 1200; x += 1200) air.push_back(rectangle(x, -1000, x + 800, 1000));
    return air;
  };
  const Extrude bead = wall({{0, 0}, {30000, 0}});
  CHECK(marked({bead}, {rectangle(10000, 0, 10800, 1000)}).size() == 1);  // half of its width
  const auto pieces = marked({bead}, comb(8));
  check_whole(bead, pieces);
  REQUIRE(pieces.size() == 3);
  CHECK(pieces[1].air_quarters == 3);  // two thirds
  CHECK(length_of(pieces[1]) == Approx(9.2).margin(1));
}

TEST_CASE("overhangs: what lies on nothing is told from half a millimetre on, and is a strand from one on",
          "[overhangs]") {
  for (Um begin = 10000; begin < 10400; begin += 130) {  // wherever it lies between looks
    const Extrude bead = wall({{0, 0}, {30000, 0}});
    const auto over = [&](Um um) { return marked({bead}, {rectangle(begin, -1000, begin + um, 1000)}); };
    CHECK(over(400).size() == 1);
    for (const Um um : {700, 1200}) {
      INFO("air from " << begin << " µm on, " << um << " µm long");
      const auto pieces = over(um);
      check_whole(bead, pieces);
      REQUIRE(pieces.size() == 3);
      CHECK(pieces[1].role == Role::overhang_wall);
      CHECK(length_of(pieces[1]) == Approx(um / 1000.0).margin(0.06));
      CHECK(is_strand(pieces[1]) == (um > 1000));
    }
  }
}

TEST_CASE("overhangs: a fin thinner than a bead may be hangs with all of the plastic that is laid for it",
          "[overhangs]") {
  const Um thickness = GENERATE(60, 100, 250);
  CAPTURE(thickness);
  Extrude fin = wall({{0, 0}, {6000, 0}});
  for (Junction& j : fin.path) j.flow = static_cast<float>(thickness) / band;
  const auto pieces = marked({fin}, {rectangle(1000, -thickness / 2, 6000, thickness / 2)});
  check_whole(fin, pieces);
  REQUIRE(pieces.size() == 2);
  CHECK(pieces[0].air_quarters == 0);
  CHECK(pieces[1].role == Role::overhang_wall);
  CHECK(length_of(pieces[1]) == Approx(5).margin(0.05));
  CHECK(pieces[1].path.back() == fin.path.back());  // held at one end: no strand
}

TEST_CASE("overhangs: a corner that sticks out is told", "[overhangs]") {
  const Extrude loop = wall({{0, 0}, {20000, 0}, {20000, 10000}, {0, 10000}}, true);
  const auto pieces = marked({loop}, {rectangle(19300, 9300, 21000, 11000)});
  check_whole(loop, pieces);
  REQUIRE(pieces.size() == 3);
  CHECK(pieces[1].role == Role::overhang_wall);
  CHECK(!is_strand(pieces[1]));
  CHECK(length_of(pieces[1]) == Approx(1.4).margin(0.06));
}

TEST_CASE("overhangs: what does not hang is not touched", "[overhangs][law]") {
  const Regions window{rectangle(10000, -1000, 19000, 2000)};
  const auto same = [&](const Extrude& bead, const Regions& over_air) {
    const auto out = marked({bead}, over_air);
    REQUIRE(out.size() == 1);
    CHECK(out[0].path == bead.path);
    CHECK(out[0].role == bead.role);
    CHECK(out[0].air_quarters == 0);
  };
  same(wall({{0, 0}, {30000, 0}}), {});
  same(wall({{0, 5000}, {30000, 5000}}), window);                            // beside it
  same(wall({{0, 0}, {30000, 0}}), {rectangle(0, -230, 30000, -170)});       // 30 µm of it: a rough wall
  same(wall({{0, 0}, {30000, 0}}), {rectangle(10000, -1000, 10300, 1000)});  // a slit of 0.3 mm
  same(wall({{0, 0}, {30000, 0}}, false, Role::infill), window);             // neither wall nor skin
  same(wall({{0, 0}, {30000, 0}}, false, Role::bridge), window);             // laid for it
  Extrude ramp = wall({{0, 0}, {30000, 0}});
  ramp.below = {200, 0};
  same(ramp, window);
}

TEST_CASE("overhangs: pieces say of what loop they are, and keep their scope and tool", "[overhangs]") {
  Extrude loop = wall({{0, 0}, {3000, 0}, {3000, 3000}, {0, 3000}}, true);
  loop.loop_length = 12000, loop.scope = 3, loop.tool = 1;
  for (const Extrude& piece : marked({loop}, {rectangle(-1000, -1000, 4000, 1500)})) {
    CHECK(piece.loop_length == 12000);
    CHECK(piece.scope == 3);
    CHECK(piece.tool == 1);
  }
}

TEST_CASE("overhangs: junctions on one another, and walls along the edge of what hangs, are borne", "[overhangs]") {
  const Regions window{rectangle(10000, -1000, 19000, 0)};
  const Extrude bead = wall({{0, 0}, {10000, 0}, {10000, 0}, {19000, 0}, {30000, 0}});
  const auto pieces = marked({bead}, window);
  check_whole(bead, pieces);
  for (const Extrude& piece : pieces) CHECK(piece.air_quarters <= 2);
}
