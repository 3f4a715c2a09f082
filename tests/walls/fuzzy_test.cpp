// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/fuzzy.h"

#include "shapes.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

namespace {

/// A box with a hole in it.
Regions frame() {
  Region out = rectangle(0, 0, 30_mm, 20_mm);
  out.holes.push_back({{10_mm, 5_mm}, {10_mm, 15_mm}, {20_mm, 15_mm}, {20_mm, 5_mm}});
  return {out};
}

Beads walls_of(const WallSettings& settings, const Regions& regions, std::size_t index = 1) {
  const SlicedLayer layer = layer_of(regions);
  return walls::build(settings, {.layer = layer, .index = index, .nozzle_diameter = usual_nozzle}).beads;
}

/// How far a point is from the closed path.
double off(const Bead& bead, Point p) {
  double least = 1e9;
  for (std::size_t i = 0, j = bead.path.size() - 1; i < bead.path.size(); j = i++) {
    const Point a = bead.path[j].at, b = bead.path[i].at;
    const double l2 = static_cast<double>(distance2(a, b));
    const double t = l2 > 0 ? std::clamp(static_cast<double>(dot(p - a, b - a)) / l2, 0.0, 1.0) : 0;
    least = std::min(least, std::hypot(p.x - a.x - t * (b.x - a.x), p.y - a.y - t * (b.y - a.y)));
  }
  return least;
}

bool same(const Bead& a, const Bead& b) {
  return a.path == b.path;
}

WallSettings fuzzy() {
  WallSettings settings = by_volume();
  settings.wall_line_count = 2;
  settings.magic_fuzzy_skin_enabled = true;
  return settings;
}

}  // namespace

TEST_CASE("walls: rough walls stand off by up to their thickness, about as often as asked, and inner walls stay",
          "[walls]") {
  WallSettings plain = fuzzy();
  plain.magic_fuzzy_skin_enabled = false;
  const auto before = walls_of(plain, frame()), after = walls_of(fuzzy(), frame());
  REQUIRE(before.size() == after.size());
  std::size_t rough = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (same(before[i], after[i])) continue;
    ++rough;
    CHECK(after[i].inset == 0);
    CHECK(walls::runs_outside(after[i]));  // the hole stays smooth
    double most = 0;
    for (const auto& j : after[i].path) most = std::max(most, off(before[i], j.at));
    CHECK(most <= 301);  // and a micron for the lattice
    CHECK(most > 250);   // of a hundred points one is far out
    const double apart = 1000 * length_mm(before[i]) / static_cast<double>(after[i].path.size());
    CHECK(apart == Approx(800).epsilon(0.1));
  }
  CHECK(rough == 1);
  WallSettings all = fuzzy();
  all.magic_fuzzy_skin_outside_only = false;
  const auto holes = walls_of(all, frame());
  std::size_t rough_too = 0;
  for (std::size_t i = 0; i < before.size(); ++i) rough_too += same(before[i], holes[i]) ? 0U : 1U;
  CHECK(rough_too == 2);
}

TEST_CASE("walls: rough walls hang on the seed and the layer alone", "[walls]") {
  const auto one = walls_of(fuzzy(), frame(), 3), again = walls_of(fuzzy(), frame(), 3);
  REQUIRE(one.size() == again.size());
  for (std::size_t i = 0; i < one.size(); ++i) CHECK(same(one[i], again[i]));
  const auto differs = [&](const Beads& other) {
    return std::any_of(one.begin(), one.end(), [&](const Bead& bead) {
      return std::none_of(other.begin(), other.end(), [&](const Bead& o) { return same(o, bead); });
    });
  };
  CHECK(differs(walls_of(fuzzy(), frame(), 4)));
  WallSettings seeded = fuzzy();
  seeded.fuzzy_skin_seed = 7;
  CHECK(differs(walls_of(seeded, frame(), 3)));
  Regions moved = frame();
  for (auto& region : moved) {
    for (auto& p : region.outer) p = p + Point{12345, -777};
    for (auto& hole : region.holes)
      for (auto& p : hole) p = p + Point{12345, -777};
  }
  const auto there = walls_of(fuzzy(), moved, 3);
  REQUIRE(there.size() == one.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    REQUIRE(there[i].path.size() == one[i].path.size());
    for (std::size_t k = 0; k < one[i].path.size(); ++k)
      CHECK(there[i].path[k].at == one[i].path[k].at + Point{12345, -777});
  }
  WallSettings plain = fuzzy();
  plain.magic_fuzzy_skin_enabled = false;
  const auto first = walls_of(fuzzy(), frame(), 0), smooth = walls_of(plain, frame(), 0);
  for (std::size_t i = 0; i < first.size(); ++i) CHECK(same(first[i], smooth[i]));
}

TEST_CASE("walls: by width a rough wall keeps its inner edge", "[walls]") {
  WallSettings settings = fuzzy(), plain = fuzzy();
  settings.fuzzy_skin_mode = FuzzyMode::width;
  plain.magic_fuzzy_skin_enabled = false;
  const auto before = walls_of(plain, frame()), after = walls_of(settings, frame());
  double widest = 0, narrowest = 1e9;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (same(before[i], after[i])) continue;
    for (const auto& j : after[i].path) {
      widest = std::max<double>(widest, j.width), narrowest = std::min<double>(narrowest, j.width);
      const double nominal = before[i].path.front().width;
      // The centre goes out by half of what the bead gets wider, and in by half of what it gets narrower.
      CHECK(off(before[i], j.at) == Approx(std::abs(j.width - nominal) / 2).margin(2));
    }
  }
  CHECK(widest > 600);
  CHECK(narrowest >= 200);  // min_output_width
}

TEST_CASE("walls: a single wall in the first layer, on the last, or wherever nothing lies above", "[walls]") {
  WallSettings settings = by_volume();
  settings.wall_line_count = 3;
  const Regions here{rectangle(0, 0, 30_mm, 20_mm)}, half{rectangle(0, 0, 12_mm, 20_mm)};
  const SlicedLayer layer = layer_of(here);
  const auto built = [&](std::size_t index, const Regions* above) {
    return walls::build(settings, {.layer = layer, .index = index, .nozzle_diameter = usual_nozzle, .above = above});
  };
  const auto insets = [](const WallLayer& walls) {
    std::array<std::size_t, 4> out{};
    for (const Bead& bead : walls.beads) ++out.at(bead.inset);
    return out;
  };
  using Counts = std::array<std::size_t, 4>;
  CHECK(insets(built(0, &here)) == Counts{1, 1, 1, 0});
  settings.initial_layer_one_wall = true;
  CHECK(insets(built(0, &here)) == Counts{1, 0, 0, 0});
  CHECK(insets(built(1, &here)) == Counts{1, 1, 1, 0});
  settings.top_one_wall = OneWall::topmost;
  CHECK(insets(built(1, nullptr)) == Counts{1, 0, 0, 0});
  CHECK(insets(built(1, &half)) == Counts{1, 1, 1, 0});
  settings.top_one_wall = OneWall::top;
  CHECK(insets(built(1, nullptr)) == Counts{1, 0, 0, 0});
  CHECK(insets(built(1, &here)) == Counts{1, 1, 1, 0});
  const auto stepped = built(1, &half);
  CHECK(insets(stepped) == Counts{1, 1, 1, 0});
  for (const Bead& bead : stepped.beads) {
    CHECK(bead.role == (bead.inset == 0 ? Role::outer_wall : Role::inner_wall));
    if (bead.inset > 0)
      for (const auto& j : bead.path) CHECK(j.at.x <= 12_mm);  // they stay under what stands above
  }
  // Nothing is lost: walls and what they leave are the part, to a hundredth for corners.
  double mm3 = 0;
  for (const Bead& bead : stepped.beads) mm3 += volume_mm3(bead, layer.height);
  CHECK(mm3 / to_mm(layer.height) + area_mm2(stepped.inside) == Approx(600).epsilon(0.01));
}
