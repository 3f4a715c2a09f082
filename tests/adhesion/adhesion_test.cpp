// SPDX-License-Identifier: GPL-3.0-or-later
#include "adhesion/adhesion.h"

#include "adhesion/loops.h"
#include "model/flow.h"
#include "picture.h"
#include "rectangle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <catch2/catch.hpp>

using namespace weft;
using adhesion::AdhesionInput;
using adhesion::PlateLayer;
using test::rectangle;

namespace {

Region frame() {
  Region r = rectangle(0, 0, 40000, 40000);
  r.holes.push_back({{10000, 10000}, {10000, 30000}, {30000, 30000}, {30000, 10000}});
  return r;
}

AdhesionSettings none() {
  AdhesionSettings s;
  s.skirt_line_count = 0;
  s.skirt_brim_line_width = 450;
  return s;
}

adhesion::Adhesion build(const AdhesionSettings& settings, const Regions& outlines, std::size_t layers = 1,
                         const Ring* surface = nullptr) {
  const std::vector<PlateLayer> plate(layers, {outlines, 200});
  tests::look_at(outlines);
  auto out = adhesion::build(settings, {plate, 400, surface});
  for (const Beads& beads : out.layers) tests::show_beads(beads);
  return out;
}

/// Distance of a point from the edges of a region, µm.
double off_edge(const Regions& regions, Point p) {
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i], b = ring[(i + 1) % ring.size()];
      const double l2 = static_cast<double>(distance2(a, b));
      const double t = std::clamp(static_cast<double>(dot(b - a, p - a)) / l2, 0.0, 1.0);
      least = std::min(least, std::hypot(a.x + t * (b.x - a.x) - p.x, a.y + t * (b.y - a.y) - p.y));
    }
  };
  for (const Region& r : regions) {
    look(r.outer);
    for (const Ring& hole : r.holes) look(hole);
  }
  return least;
}

double volume(const Beads& beads) {
  double sum = 0;
  for (const Bead& b : beads) sum += volume_mm3(b, 200);
  return sum;
}

}  // namespace

TEST_CASE("adhesion: a skirt keeps its distance and its count, the outermost loop first", "[adhesion]") {
  AdhesionSettings s = none();
  s.skirt_line_count = 3, s.skirt_gap = 5000;
  const Regions parts{rectangle(0, 0, 20000, 20000), rectangle(40000, 0, 60000, 10000)};
  const auto result = build(s, parts);
  REQUIRE(result.layers.size() == 1);
  const Beads& beads = result.layers[0];
  REQUIRE(beads.size() == 3);
  const Um band = flow::band(450, 200);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(beads[i].closed);
    CHECK(beads[i].role == Role::skirt);
    double least = 1e9;
    for (const Junction& j : beads[i].path) least = std::min(least, off_edge(parts, j.at));
    CHECK(least == Approx(5000 + (2.5 - static_cast<double>(i)) * band).margin(30));
  }
  CHECK(result.notices.empty());
}

TEST_CASE("adhesion: a skirt stands on as many layers as asked for, around all of them", "[adhesion]") {
  AdhesionSettings s = none();
  s.skirt_line_count = 1, s.skirt_height = 3, s.skirt_gap = 2000;
  const std::vector<PlateLayer> plate{{{rectangle(0, 0, 10000, 10000)}, 300}, {{rectangle(0, 0, 20000, 10000)}, 200}};
  const auto result = adhesion::build(s, {plate, 400, nullptr});
  REQUIRE(result.layers.size() == 2);  // the print ends there
  for (const Beads& beads : result.layers) {
    REQUIRE(beads.size() == 1);
    Box box;
    for (const Junction& j : beads[0].path) box.add(j.at);
    CHECK(box.max.x > 22000);
  }
}

TEST_CASE("adhesion: loops are added up to the minimal length, on the first layer", "[adhesion]") {
  AdhesionSettings s = none();
  s.skirt_line_count = 1, s.skirt_height = 2, s.skirt_brim_minimal_length = 500000;
  const auto result = build(s, {rectangle(0, 0, 10000, 10000)}, 2);
  double first = 0;
  for (const Bead& b : result.layers[0]) first += length_mm(b);
  CHECK(first >= 500);
  CHECK(first < 500 + length_mm(result.layers[0].front()));
  CHECK(result.layers[1].size() == 1);
}

TEST_CASE("adhesion: a brim fills its width from its gap on, the last loop at the part", "[adhesion][law]") {
  AdhesionSettings s = none();
  s.brim_width = GENERATE(400, 3000, 8100);
  s.brim_gap = GENERATE(0, 150);
  const Regions part{rectangle(0, 0, 30000, 20000)};
  const Beads beads = build(s, part).layers.at(0);
  REQUIRE(!beads.empty());
  const double w = to_mm(s.brim_width), g = to_mm(s.brim_gap), pi = std::numbers::pi;
  const double area = 2 * 50 * w + pi * ((w + g) * (w + g) - g * g);
  CHECK(volume(beads) == Approx(area * 0.2).epsilon(0.01));
  const auto away = [&](const Bead& b) { return off_edge(part, b.path.front().at); };
  CHECK(away(beads.back()) == Approx(s.brim_gap + beads.back().path[0].width / 2.0).margin(30));
  for (std::size_t i = 1; i < beads.size(); ++i) CHECK(away(beads[i]) < away(beads[i - 1]));
}

TEST_CASE("adhesion: brims outside, inside and everywhere", "[adhesion]") {
  AdhesionSettings s = none();
  s.brim_width = 4000;
  const auto inside_hole = [](const Bead& b) {
    const Point p = b.path.front().at;
    return p.x > 10000 && p.x < 30000 && p.y > 10000 && p.y < 30000;
  };
  for (const BrimLocation location : {BrimLocation::outside, BrimLocation::inside, BrimLocation::everywhere}) {
    s.brim_location = location;
    const Beads beads = build(s, {frame()}).layers.at(0);
    const auto inner = std::count_if(beads.begin(), beads.end(), inside_hole);
    const auto outer = static_cast<std::ptrdiff_t>(beads.size()) - inner;
    CHECK((inner > 0) == (location != BrimLocation::outside));
    CHECK((outer > 0) == (location != BrimLocation::inside));
  }
}

TEST_CASE("adhesion: brims of neighbours merge and never lie on a part", "[adhesion][law]") {
  AdhesionSettings s = none();
  s.brim_width = 5000, s.brim_gap = 100;
  s.brim_location = GENERATE(BrimLocation::outside, BrimLocation::inside, BrimLocation::everywhere);
  const Regions parts{frame(), rectangle(18000, 18000, 21000, 21000), rectangle(43000, 0, 60000, 30000)};
  const Beads beads = build(s, parts).layers.at(0);
  REQUIRE(!beads.empty());
  bool island = false;
  for (const Bead& b : beads)
    for (const Junction& j : b.path) {
      CHECK(off_edge(parts, j.at) >= s.brim_gap + b.path[0].width / 2.0 - 30);
      for (const Region& r : parts) {
        const bool in_hole = !r.holes.empty() && side_of(r.holes[0], j.at) == Side::inside;
        CHECK((side_of(r.outer, j.at) == Side::outside || in_hole));
      }
      island |= j.at.x > 15000 && j.at.x < 24000 && j.at.y > 15000 && j.at.y < 24000;
    }
  CHECK(island == (s.brim_location != BrimLocation::inside));  // the part in the hole has a brim of its own
}

TEST_CASE("adhesion: the skirt stays clear of the brim", "[adhesion]") {
  AdhesionSettings s = none();
  s.brim_width = 5000, s.skirt_line_count = 1, s.skirt_gap = 1000;
  const Regions part{rectangle(0, 0, 30000, 20000)};
  const Beads beads = build(s, part).layers.at(0);
  CHECK(beads.front().role == Role::skirt);
  double least = 1e9;
  for (const Junction& j : beads.front().path) least = std::min(least, off_edge(part, j.at));
  CHECK(least == Approx(6000 + beads.front().path[0].width / 2.0).margin(30));
}

TEST_CASE("adhesion: what leaves the print surface is kept, or cut with a notice", "[adhesion]") {
  AdhesionSettings s = none();
  s.skirt_line_count = 2, s.skirt_gap = 3000, s.brim_width = 2000;
  const Ring surface{{0, 0}, {100000, 0}, {100000, 100000}, {0, 100000}};
  const Regions part{rectangle(1000, 40000, 20000, 60000)};
  const auto out = [&](const adhesion::Adhesion& a) {
    return std::any_of(a.layers[0].begin(), a.layers[0].end(), [&](const Bead& b) {
      return std::any_of(b.path.begin(), b.path.end(), [&](const Junction& j) { return j.at.x < j.width / 2; });
    });
  };
  CHECK(out(build(s, part, 1, &surface)));
  s.adhesion_outside = AdhesionOutside::clip;
  const auto clipped = build(s, part, 1, &surface);
  CHECK(!out(clipped));
  CHECK(clipped.layers[0].size() >= 4);
  REQUIRE(clipped.notices.size() == 2);
  CHECK(clipped.notices[0].code == "brim_clipped");
  CHECK(clipped.notices[1].code == "skirt_clipped");
  const Regions middle{rectangle(40000, 40000, 60000, 60000)};
  CHECK(build(s, middle, 1, &surface).notices.empty());
}

TEST_CASE("adhesion: a brim where the foot is narrow holds fins, not blocks", "[adhesion]") {
  AdhesionSettings s;
  s.skirt_line_count = 0;
  s.brim_width = 4000, s.brim_narrow_width = 8000;
  const Regions block{rectangle(0, 0, 40000, 40000)};
  CHECK(build(s, block).layers[0].empty());
  // A fin of 3 mm that stands out 25 mm from a block.
  const Regions fin{
      {{{0, 0}, {40000, 0}, {40000, 18000}, {65000, 18000}, {65000, 21000}, {40000, 21000}, {40000, 40000}, {0, 40000}},
       {}}};
  const auto brim = build(s, fin);
  REQUIRE_FALSE(brim.layers[0].empty());
  double length = 0;
  for (const Bead& bead : brim.layers[0]) {
    length += length_mm(bead);
    for (const Junction& j : bead.path) CHECK(j.at.x > 40000 - 4100);
  }
  s.brim_narrow_width = 0;
  double all = 0;
  const auto whole = build(s, fin);
  for (const Bead& bead : whole.layers[0]) all += length_mm(bead);
  CHECK(length > 0.15 * all);
  CHECK(length < 0.5 * all);
}

TEST_CASE("adhesion: feet have brims of their own, which keep off each other and off what stands there", "[adhesion]") {
  AdhesionSettings none;
  none.skirt_line_count = 0, none.brim_width = 0;
  auto wide = none, narrow = none;
  wide.brim_width = 6000, narrow.brim_width = 2000, narrow.brim_gap = 500;
  const Regions a{rectangle(0, 0, 10000, 10000)}, b{rectangle(14000, 0, 24000, 10000)},
      c{rectangle(28000, 0, 38000, 10000)};
  Regions all = a;
  all.insert(all.end(), b.begin(), b.end()), all.insert(all.end(), c.begin(), c.end());
  const std::vector<PlateLayer> plate{{all, 200}};
  const std::vector<adhesion::Foot> feet{{a, wide}, {b, narrow}, {c, none}};
  const auto built = adhesion::build(none, {plate, 400, nullptr, feet});
  REQUIRE(built.layers.size() == 1);
  for (const Bead& bead : built.layers[0]) {
    for (std::size_t i = 0; i + 1 < bead.path.size(); ++i) {
      const Point p = bead.path[i].at;
      for (const auto& region : all) CHECK(side_of(region.outer, p) == Side::outside);
      CHECK(p.x < 28000);  // none at c
    }
  }
  const auto reaches = [&](Um x) {
    return std::any_of(built.layers[0].begin(), built.layers[0].end(), [&](const Bead& bead) {
      return std::any_of(bead.path.begin(), bead.path.end(), [&](const Junction& j) { return j.at.x < x; });
    });
  };
  CHECK(reaches(-5000));  // the wide one
  CHECK_FALSE(reaches(-6000));
}

TEST_CASE("adhesion: nothing to print, nothing around it", "[adhesion]") {
  AdhesionSettings s;
  s.brim_width = 4000;
  CHECK(adhesion::build(s, {{}, 400, nullptr}).layers.empty());
  CHECK(build(s, {}).layers.at(0).empty());
  CHECK(build(none(), {rectangle(0, 0, 1000, 1000)}).layers.empty());
}
