// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/sparse.h"

#include "areas.h"
#include "geometry/offset.h"
#include "picture.h"

#include <algorithm>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;
using infill::SparseStyle;

namespace {
std::vector<InfillPattern> all_patterns() {
  std::vector<InfillPattern> out;
  for (const auto& choice : choices_of(InfillPattern{})) out.push_back(choice.value);
  return out;
}

Beads filled(const Region& region, const SparseStyle& style) {
  Beads beads;
  tests::look_at({region});
  infill::fill_sparse(region, style, beads);
  tests::show_beads(beads);
  return beads;
}
}  // namespace

TEST_CASE("sparse: the volume is the density's share of the area", "[infill][law]") {
  const InfillPattern pattern = GENERATE(from_range(all_patterns()));
  const double density = GENERATE(0.1, 0.2, 0.4, 0.7);
  // these have the density over a period of the height
  if (pattern == InfillPattern::lateral_honeycomb || pattern == InfillPattern::schwarz_p) return;
  const bool connect = GENERATE(true, false);
  const Region region = with_hole(rectangle(-50000, -50000, 50000, 50000), -9000, -9000, 12000, 15000);
  for (const Um z : {200, 1000, 2400, 3600}) {
    const Beads beads = filled(region, {.pattern = pattern,
                                        .density = density,
                                        .band = 420,
                                        .angle_rad = degrees(45),
                                        .overlap = {45},
                                        .connect = connect,
                                        .z = z,
                                        .reach = 50000});
    CAPTURE(static_cast<int>(pattern), density, connect, z);
    CHECK(covered_mm2(beads) / area_mm2(region) == Approx(density).epsilon(0.02));
  }
}

TEST_CASE("sparse: lines stay inside, and reach the edge", "[infill][law]") {
  const InfillPattern pattern = GENERATE(from_range(all_patterns()));
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const Region region = star(seed, 15000, 15);
    for (const Bead& bead :
         filled(region, {.pattern = pattern, .density = 0.25, .band = 420, .angle_rad = degrees(45), .z = 3000})) {
      CHECK(bead.role == Role::infill);
      REQUIRE(bead.path.size() >= 2);
      for (const Junction& j : bead.path) {
        bool near = side_of(region.outer, j.at) != Side::outside;
        for (const Point by : {Point{3, 0}, Point{-3, 0}, Point{0, 3}, Point{0, -3}})
          near |= side_of(region.outer, j.at + by) != Side::outside;
        CHECK(near);
      }
    }
  }
}

TEST_CASE("sparse: no line comes further out than the walls are deep, in whatever corner", "[infill][law]") {
  const InfillPattern pattern = GENERATE(from_range(all_patterns()));
  const bool connect = GENERATE(true, false);
  constexpr Um um = 200, most_um = 300, arcs_um = 5;
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const Region region = star(seed, 15000, 15);
    const Regions walls = geometry::offset({region}, {.by = most_um + arcs_um, .corner = geometry::Corner::round});
    const Beads beads = filled(region, {.pattern = pattern,
                                        .density = 0.25,
                                        .band = 420,
                                        .angle_rad = degrees(45),
                                        .overlap = {um, most_um},
                                        .connect = connect,
                                        .z = 3000});
    for (const Bead& bead : beads)
      for (const Junction& j : bead.path) {
        CAPTURE(seed, static_cast<int>(pattern), connect, j.at.x, j.at.y);
        CHECK(holds(walls, j.at));
      }
  }
}

TEST_CASE("sparse: a line that grazes a round wall gives way to it", "[infill]") {
  // spacing 2.1 mm: a hole touches lines that run by up to half a band outside of it
  for (const Um radius : {4'000, 4'100, 4'190}) {
    Region region = rectangle(-20'000, -20'000, 20'000, 20'000);
    Ring hole;
    for (int k = 0; k < 96; ++k) {
      const double a = -2 * std::numbers::pi * k / 96;
      hole.push_back({rounded(radius * std::cos(a)), rounded(radius * std::sin(a))});
    }
    region.holes.push_back(hole);
    int grazing = 0;
    for (const Bead& bead :
         filled(region, {.pattern = InfillPattern::lines, .density = 0.2, .band = 420, .connect = false}))
      for (std::size_t i = 1; i < bead.path.size(); ++i) {
        const Point a = bead.path[i - 1].at, b = bead.path[i].at;
        for (int t = 0; t <= 20; ++t) {
          const double x = std::lerp(a.x, b.x, t / 20.0), y = std::lerp(a.y, b.y, t / 20.0);
          if (std::abs(x) > 900 || std::abs(y) > radius + 600) continue;
          ++grazing;
          CAPTURE(radius, x, y);
          CHECK(std::hypot(x, y) >= radius + 210 - 25);  // what is less is not worth a junction
        }
      }
    CHECK(grazing > 0);
  }
}

TEST_CASE("sparse: a joint does not leave the area through a notch", "[infill]") {
  // Areas found on a grid have notches a few hundredths wide beside walls that are exact.
  const Ring ring{{0, 0}, {30'000, 0}, {30'000, 12'000}, {44, 12'000}, {44, 12'200}, {0, 12'200}};
  for (Um x = -6'000; x < 0; x += 100) {
    Ring moved = ring;
    for (Point& p : moved) p.x += x;
    for (const Bead& bead :
         filled({moved, {}}, {.pattern = InfillPattern::grid, .density = 0.3, .band = 420, .angle_rad = degrees(45)}))
      for (const Junction& j : bead.path) {
        CAPTURE(x, j.at.x, j.at.y);
        CHECK(j.at.x >= x - 2);
        CHECK(j.at.y <= 12'202);
      }
  }
}

TEST_CASE("sparse: joining lines saves travels", "[infill]") {
  const Region square = rectangle(0, 0, 40000, 40000);
  for (const InfillPattern pattern : {InfillPattern::lines, InfillPattern::grid, InfillPattern::triangles}) {
    SparseStyle style{.pattern = pattern, .density = 0.2, .band = 420, .angle_rad = degrees(45)};
    const std::size_t joined = filled(square, style).size();
    style.connect = false;
    const std::size_t apart = filled(square, style).size();
    CAPTURE(static_cast<int>(pattern));
    CHECK(joined * 4 < apart);
  }
}

TEST_CASE("sparse: between two walls some lines apart it is joined, also where that takes more than it is dense",
          "[infill]") {
  const Um width = GENERATE(700, 1000, 1400);
  const bool wide = GENERATE(false, true);  // beside it: lines of all lengths
  constexpr Um length = 60'000;
  Region region = rectangle(0, 0, length, width);
  if (wide)
    region.outer = {{0, 0}, {length + 4000, 0}, {length + 4000, 12'000}, {length, 12'000}, {length, width}, {0, width}};
  const Beads beads = filled(region, {.pattern = InfillPattern::grid,
                                      .density = 0.2,
                                      .band = 420,
                                      .angle_rad = degrees(45),
                                      .overlap = {60},
                                      .connect = true});
  CAPTURE(width, wide);
  CHECK(beads.size() <= 4);
  std::size_t dashes = 0;
  for (const Bead& bead : beads) dashes += length_mm(bead) < 2;
  CHECK(dashes <= 1);
}

TEST_CASE("sparse: layers stand on each other", "[infill][law]") {
  // The lattice is anchored at the origin: another area of the same layer carries on the same lines.
  const SparseStyle style{
      .pattern = InfillPattern::grid, .density = 0.2, .band = 420, .angle_rad = 0, .connect = false};
  std::vector<Um> large, small;
  const auto horizontals = [](const Beads& beads, std::vector<Um>& ys) {
    for (const Bead& bead : beads)
      if (bead.path.front().at.y == bead.path.back().at.y) ys.push_back(bead.path.front().at.y);
  };
  horizontals(filled(rectangle(-30000, -30000, 30000, 30000), style), large);
  horizontals(filled(rectangle(-7777, -9999, 8123, 12345), style), small);
  REQUIRE(small.size() >= 4);
  for (const Um y : small) CHECK(std::find(large.begin(), large.end(), y) != large.end());
}

TEST_CASE("sparse: nothing, specks and needles are borne", "[infill]") {
  const InfillPattern pattern = GENERATE(from_range(all_patterns()));
  const SparseStyle style{.pattern = pattern, .density = 0.2, .band = 420, .overlap = {40}};
  CHECK(filled({}, style).empty());
  filled(rectangle(0, 0, 1, 1), style);
  filled({{{0, 0}, {50000, 1}, {0, 2}}, {}}, style);
  filled({{{0, 0}, {1000, 0}, {2000, 0}}, {}}, style);
}
