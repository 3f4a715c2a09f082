// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/streamlines.h"

#include "areas.h"
#include "infill/prepared.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;
using infill::SparseStyle;

namespace {

constexpr double half = 20;  // mm

/// Directions around the middle, as hoops; on a lattice of 1 mm.
infill::Prepared hoops() {
  field::TensorGrid t;
  constexpr int n = 51;
  for (field::Grid* g : {&t.xx, &t.yy, &t.xy}) g->columns = g->rows = n, g->x0 = g->y0 = -25;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const double x = i - 25, y = j - 25;
      t.xx.values.push_back(static_cast<float>(y * y)), t.yy.values.push_back(static_cast<float>(x * x));
      t.xy.values.push_back(static_cast<float>(-x * y));
    }
  infill::Prepared out;
  out.direction.emplace(std::move(t), Point{});
  return out;
}

Beads filled(const infill::Prepared* prepared, const SparseStyle& like = {}) {
  SparseStyle style = like;
  style.pattern = InfillPattern::streamlines, style.density = 0.2, style.band = 420, style.prepared = prepared;
  style.connect = false;
  Beads beads;
  const auto h = static_cast<Um>(1000 * half);
  infill::fill_sparse(rectangle(-h, -h, h, h), style, beads);
  tests::show_beads(beads);
  return beads;
}

}  // namespace

TEST_CASE("streamlines: lines follow the field and keep their distance", "[infill][law]") {
  const infill::Prepared prepared = hoops();
  const Beads beads = filled(&prepared);
  REQUIRE(beads.size() > 5);
  double error = 0, length = 0;
  for (const Bead& bead : beads)
    for (std::size_t i = 1; i < bead.path.size(); ++i) {
      const Point a = bead.path[i - 1].at, b = bead.path[i].at;
      const double x = (a.x + b.x) / 2.0, y = (a.y + b.y) / 2.0, way = distance(a, b);
      if (std::hypot(x, y) < 4'000) continue;  // in the middle all directions are alike
      const double off = std::remainder(std::atan2(b.y - a.y, b.x - a.x) - std::atan2(x, -y), std::numbers::pi);
      error += way * std::abs(off), length += way;
    }
  CHECK(error / length * 180 / std::numbers::pi <= 3);
  // along a ray, hoops 2.1 mm apart: from 0.7 to 1.4 of that
  std::vector<double> radii;
  for (const Bead& bead : beads)
    for (std::size_t i = 1; i < bead.path.size(); ++i) {
      const Point a = bead.path[i - 1].at, b = bead.path[i].at;
      if ((a.y > 0) == (b.y > 0) || std::min(a.x, b.x) < 0) continue;
      radii.push_back(std::lerp(a.x, b.x, static_cast<double>(a.y) / (a.y - b.y)));
    }
  std::sort(radii.begin(), radii.end());
  REQUIRE(radii.size() >= 7);
  for (std::size_t i = 1; i < radii.size(); ++i) {
    CAPTURE(radii[i - 1], radii[i]);
    CHECK(radii[i] - radii[i - 1] >= 0.7 * 2'100);
    CHECK(radii[i] - radii[i - 1] <= 1.45 * 2'100);
  }
}

TEST_CASE("streamlines: they hold the density, with a field and without one", "[infill][law]") {
  const infill::Prepared prepared = hoops();
  for (const infill::Prepared* each : {static_cast<const infill::Prepared*>(nullptr), &prepared}) {
    const Beads beads = filled(each, {.angle_rad = degrees(30)});
    CHECK(covered_mm2(beads) / (4 * half * half) == Approx(0.2).epsilon(0.02));
  }
}

TEST_CASE("streamlines: without a field they are straight, and run across on every second layer", "[infill]") {
  for (const std::size_t index : {std::size_t{0}, std::size_t{1}}) {
    const double angle = degrees(index == 0 ? 30 : 120);
    for (const Bead& bead : filled(nullptr, {.angle_rad = degrees(30), .turn = index})) {
      const Point a = bead.path.front().at, b = bead.path.back().at;
      CHECK(std::remainder(std::atan2(b.y - a.y, b.x - a.x) - angle, std::numbers::pi) == Approx(0).margin(0.02));
    }
  }
}
