// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/pattern.h"

#include "areas.h"
#include "infill/cube_tree.h"
#include "infill/lightning.h"
#include "infill/sparse.h"
#include "picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;
using infill::Curve;
using infill::PatternPlace;
using infill::SparseStyle;

namespace {

PatternPlace place(double half, double density, double z = 1000) {
  return {.band = 420, .density = density, .z = z, .index = 0, .area = {{-half, -half}, {half, half}}, .reach = half};
}

Beads filled(const Region& region, const SparseStyle& style) {
  Beads beads;
  infill::fill_sparse(region, style, beads);
  return beads;
}

/// How often the beads' centre lines cross each other, or themselves.
int crossings(const Beads& beads) {
  struct Segment {
    Point a, b;
  };
  std::vector<Segment> all;
  for (const Bead& bead : beads) {
    for (std::size_t i = 1; i < bead.path.size(); ++i) all.push_back({bead.path[i - 1].at, bead.path[i].at});
    if (bead.closed) all.push_back({bead.path.back().at, bead.path.front().at});
  }
  int count = 0;
  for (std::size_t i = 0; i < all.size(); ++i)
    for (std::size_t j = i + 2; j < all.size(); ++j)
      count += segments_cross(all[i].a, all[i].b, all[j].a, all[j].b) ? 1 : 0;
  return count;
}

}  // namespace

TEST_CASE("pattern: Hilbert's and Peano's curves visit every cell once and step to a neighbour", "[infill]") {
  for (const InfillPattern pattern : {InfillPattern::hilbert, InfillPattern::peano}) {
    const PatternPlace p = place(20'000, 0.3);
    const double cell = p.spacing();
    std::map<std::pair<long, long>, int> visits;
    for (const Curve& curve : infill::row_of(pattern).draw(p).curves) {
      const auto visit = [&](double x, double y) { ++visits[{std::lround(2 * x / cell), std::lround(2 * y / cell)}]; };
      visit(curve.points[0].x, curve.points[0].y);
      for (std::size_t i = 1; i < curve.points.size(); ++i) {
        const auto a = curve.points[i - 1], b = curve.points[i];
        const double dx = b.x - a.x, dy = b.y - a.y, way = std::abs(dx) + std::abs(dy);
        REQUIRE(std::min(std::abs(dx), std::abs(dy)) < 1e-6);
        for (int k = 1; k <= std::lround(way / cell); ++k) visit(a.x + k * cell * dx / way, a.y + k * cell * dy / way);
      }
    }
    CAPTURE(static_cast<int>(pattern));
    for (const auto& [at, count] : visits) REQUIRE(count == 1);
    CHECK(static_cast<double>(visits.size()) * cell * cell >= 40'000.0 * 40'000.0);
  }
}

TEST_CASE("pattern: curves cross neither each other nor themselves", "[infill]") {
  const Region square = rectangle(-15'000, -15'000, 15'000, 15'000);
  for (const InfillPattern pattern :
       {InfillPattern::lines, InfillPattern::zigzag, InfillPattern::slanted, InfillPattern::honeycomb,
        InfillPattern::octagon, InfillPattern::honeycomb_3d, InfillPattern::crosshatch, InfillPattern::gyroid,
        InfillPattern::diamond, InfillPattern::schwarz_p, InfillPattern::hilbert, InfillPattern::peano,
        InfillPattern::archimedean, InfillPattern::octagram, InfillPattern::fermat, InfillPattern::voronoi,
        InfillPattern::cross})
    for (const Um z : {200, 1400, 3100, 5300}) {
      const Beads beads = filled(square, {.pattern = pattern,
                                          .density = 0.2,
                                          .band = 420,
                                          .angle_rad = degrees(45),
                                          .overlap = {45},
                                          .z = z,
                                          .reach = 15'000});
      CAPTURE(static_cast<int>(pattern), z);
      CHECK(crossings(beads) == 0);
    }
  // where curves all but touch; these may only become fewer
  const std::array known{std::pair{InfillPattern::fischer_koch, 8}, std::pair{InfillPattern::voronoi_3d, 4},
                         std::pair{InfillPattern::cross_3d, 1}};
  for (const auto& [pattern, most] : known)
    for (const Um z : {200, 1400, 3100, 5300}) {
      CAPTURE(static_cast<int>(pattern), z);
      CHECK(crossings(filled(square, {.pattern = pattern,
                                      .density = 0.2,
                                      .band = 420,
                                      .angle_rad = degrees(45),
                                      .overlap = {45},
                                      .z = z,
                                      .reach = 15'000})) <= most);
    }
}

TEST_CASE("pattern: lines that bend where they meet cross nowhere, and hold the density", "[infill][law]") {
  const Region square = with_hole(rectangle(-25'000, -25'000, 25'000, 25'000), -5'000, -4'000, 6'000, 7'000);
  const auto crossings_bent = [&](InfillPattern pattern, Um z) {
    SparseStyle style{
        .pattern = pattern, .density = 0.2, .band = 420, .angle_rad = degrees(45), .overlap = {45}, .z = z};
    const int before = crossings(filled(square, style));
    style.bend = true;
    const Beads beads = filled(square, style);
    CAPTURE(static_cast<int>(pattern), z);
    CHECK(covered_mm2(beads) / area_mm2(square) == Approx(0.2).epsilon(0.02));
    return std::pair{before, crossings(beads)};
  };
  for (const InfillPattern pattern : {InfillPattern::grid, InfillPattern::trihexagon})
    CHECK(crossings_bent(pattern, 200).second == 0);
  // at heights where no three of their lines meet; beside walls some still cross
  for (const InfillPattern pattern : {InfillPattern::cubic, InfillPattern::tetrahedral}) {
    const auto [before, after] = crossings_bent(pattern, 1400);
    CHECK(before > 100);
    CHECK(after <= before / 20);
  }
  // all of their lines meet by threes
  const auto [before, after] = crossings_bent(InfillPattern::triangles, 200);
  CHECK(before > 100);
  CHECK(after <= before / 20);
}

TEST_CASE("pattern: medial lays one line a region, and as many beside each other where it is narrow", "[infill]") {
  const SparseStyle style{.pattern = InfillPattern::medial, .density = 0.25, .band = 420};
  CHECK(filled(rectangle(0, 0, 40'000, 25'000), style).size() == 1);
  CHECK(filled(with_hole(rectangle(-25'000, -25'000, 25'000, 25'000), -9000, -9000, 12000, 15000), style).size() == 1);
  // a wedge: lines cross a cut near its thin end as often as one near its thick end
  const Region wedge{{{0, 0}, {60'000, 8'000}, {60'000, 12'000}, {0, 20'000}}, {}};
  const auto met = [](const Beads& beads, Um x) {
    int count = 0;
    for (const Bead& bead : beads)
      for (std::size_t i = 0; i < bead.path.size(); ++i)
        count += (bead.path[i].at.x > x) != (bead.path[(i + 1) % bead.path.size()].at.x > x) ? 1 : 0;
    return count;
  };
  const Beads beads = filled(wedge, style);
  CHECK(std::abs(met(beads, 20'000) - met(beads, 45'000)) <= 2);
}

TEST_CASE("pattern: fermat lays one line a region, holes and branches or not", "[infill]") {
  const SparseStyle style{.pattern = InfillPattern::fermat, .density = 0.25, .band = 420};
  CHECK(filled(rectangle(0, 0, 40'000, 25'000), style).size() == 1);
  CHECK(filled(with_hole(rectangle(-25'000, -25'000, 25'000, 25'000), -9000, -9000, 12000, 15000), style).size() == 1);
  // a dumb-bell: two middles
  const Region bell{{{0, 0},
                     {15'000, 0},
                     {15'000, 6'000},
                     {25'000, 6'000},
                     {25'000, 0},
                     {40'000, 0},
                     {40'000, 15'000},
                     {25'000, 15'000},
                     {25'000, 9'000},
                     {15'000, 9'000},
                     {15'000, 15'000},
                     {0, 15'000}},
                    {}};
  CHECK(filled(bell, style).size() == 1);
}

TEST_CASE("pattern: lines are joined to one path where they can be", "[infill]") {
  const Region square = rectangle(-20'000, -20'000, 20'000, 20'000);
  for (const InfillPattern pattern :
       {InfillPattern::lines, InfillPattern::grid, InfillPattern::zigzag, InfillPattern::triangles})
    for (const double density : {0.1, 0.2, 0.4}) {
      CAPTURE(static_cast<int>(pattern), density);
      CHECK(filled(square,
                   {.pattern = pattern, .density = density, .band = 420, .angle_rad = degrees(45), .overlap = {45}})
                .size() <= 2);
    }
}

TEST_CASE("pattern: where a layer cannot have the density the layers of a period have it", "[infill][law]") {
  const Region square = rectangle(-40'000, -40'000, 40'000, 40'000);
  for (const InfillPattern pattern : {InfillPattern::lateral_honeycomb, InfillPattern::schwarz_p}) {
    constexpr double density = 0.2;
    const double spacing = 420 / density;
    const double period = pattern == InfillPattern::schwarz_p ? 1.886 * spacing : 2 * 2 * spacing / std::numbers::sqrt3;
    double laid = 0;
    constexpr int heights = 64;
    for (int k = 0; k < heights; ++k)
      for (const Bead& bead : filled(square, {.pattern = pattern,
                                             .density = density,
                                             .band = 420,
                                             .connect = false,
                                             .z = rounded((k + 0.5) * period / heights)}))
        laid += volume_mm3(bead, 1000) / heights;
    CAPTURE(static_cast<int>(pattern));
    CHECK(laid / area_mm2(square) == Approx(density).epsilon(0.03));
  }
}

TEST_CASE("pattern: an end without a joint is bent along the wall as far as it is asked to", "[infill]") {
  const Region square = rectangle(-20'000, -20'000, 20'000, 20'000);
  SparseStyle style{.pattern = InfillPattern::lines, .density = 0.1, .band = 420, .overlap = {45}, .anchor_max = 0};
  const Beads bare = filled(square, style);
  style.anchor_um = 1500;
  const Beads bent = filled(square, style);
  REQUIRE(bare.size() == bent.size());
  for (const Bead& bead : bent) {
    REQUIRE(bead.path.size() >= 4);
    const Point end = bead.path.back().at, corner = bead.path[bead.path.size() - 2].at;
    CHECK(distance(end, corner) == Approx(1500).margin(30));
    // beside the wall, half a band off less the overlap
    CHECK(20'000 - std::max(std::abs(end.x), std::abs(end.y)) == Approx(210 - 45).margin(3));
  }
}

TEST_CASE("cubes: they are split where the surface is, neighbours by one level at most", "[infill]") {
  constexpr double spacing = 2'000;
  infill::CubeTree cubes(spacing, 60'000);
  cubes.add(20'000, 0, 10'000);
  cubes.balance();
  /// Length of the lines within 12 mm.
  const auto length_near = [&](double x, double y, double z) {
    double length = 0;
    constexpr double step = 100;
    for (const Curve& c : cubes.cut(z)) {
      const double dx = c.points[1].x - c.points[0].x, dy = c.points[1].y - c.points[0].y, way = std::hypot(dx, dy);
      for (double t = 0; t < way; t += step)
        if (std::hypot(c.points[0].x + t / way * dx - x, c.points[0].y + t / way * dy - y) < 12'000) length += step;
    }
    return length;
  };
  CHECK(length_near(20'000, 0, 10'000) > 1.5 * length_near(-40'000, 0, 10'000));
}

TEST_CASE("lightning: each place under a top is near a branch or a wall, and a branch leans no more than it may",
          "[infill]") {
  constexpr double radius = 3'000;
  constexpr Um height = 200;
  std::vector<infill::LightningLayer> layers(60, {height, {rectangle(0, 0, 40'000, 40'000)}});
  const auto branches = infill::lightning(layers, radius, {1, 1}, {20'000, 20'000});
  REQUIRE(branches.size() == layers.size());
  const auto distance_to = [](const std::vector<Polyline>& lines, Point p) {
    double least = std::min({p.x, p.y, 40'000 - p.x, 40'000 - p.y});
    for (const Polyline& line : lines)
      for (std::size_t i = 1; i < line.size(); ++i) {
        const double dx = line[i].x - line[i - 1].x, dy = line[i].y - line[i - 1].y;
        const double t =
            std::clamp(((p.x - line[i - 1].x) * dx + (p.y - line[i - 1].y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
        least = std::min(least, std::hypot(p.x - line[i - 1].x - t * dx, p.y - line[i - 1].y - t * dy));
      }
    return least;
  };
  const auto length = [](const std::vector<Polyline>& lines) {
    double way = 0;
    for (const Polyline& line : lines) way += length_of(line);
    return way;
  };
  for (Um x = 500; x < 40'000; x += 1'000)
    for (Um y = 500; y < 40'000; y += 1'000) CHECK(distance_to(branches.back(), {x, y}) <= 1.6 * radius);
  for (std::size_t i = branches.size() - 1; i > 0; --i) {
    CHECK(length(branches[i - 1]) <= length(branches[i]));
    for (const Polyline& line : branches[i])
      for (const Point p : line) CHECK(distance_to(branches[i - 1], p) <= 1.5 * height + 60);
  }
  CHECK(length(branches.front()) < 0.5 * length(branches.back()));
}

TEST_CASE("pattern: lines side by side keep the density, and lie a band apart", "[infill]") {
  const Region square = rectangle(0, 0, 40'000, 40'000);
  for (const InfillPattern pattern : {InfillPattern::lines, InfillPattern::gyroid, InfillPattern::concentric}) {
    SparseStyle style{
        .pattern = pattern, .density = 0.2, .band = 420, .angle_rad = degrees(45), .overlap = {45}, .z = 1'000};
    style.origin = {20'000, 20'000};
    const Beads once = filled(square, style);
    style.multiplier = 3;
    const Beads thrice = filled(square, style);
    CHECK(covered_mm2(thrice) == Approx(covered_mm2(once)).epsilon(0.02));
    if (pattern != InfillPattern::gyroid) CHECK(crossings(thrice) == 0);
    // more places are far from all of them
    const auto far_places = [&](const Beads& beads) {
      int count = 0;
      for (Um y = 10'000; y < 30'000; y += 400)
        for (Um x = 10'000; x < 30'000; x += 400)
          count += cover(beads, x, y) + cover(beads, x + 900, y) + cover(beads, x - 900, y) + cover(beads, x, y + 900) +
                               cover(beads, x, y - 900) ==
                           0
                       ? 1
                       : 0;
      return count;
    };
    CHECK(far_places(thrice) > 1.2 * far_places(once));
  }
}
