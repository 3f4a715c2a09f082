// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/figures.h"

#include "areas.h"
#include "infill/sparse.h"

#include <cmath>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

namespace {

/// A block of 60 mm, 40 layers high.
infill::Figures figures(InfillPattern pattern, double density, bool joined = false) {
  const Regions outline{rectangle(-31'000, -31'000, 31'000, 31'000)},
      sparse{rectangle(-30'000, -30'000, 30'000, 30'000)};
  constexpr std::size_t layers = 40;
  std::vector<Beads> beads(layers);
  std::vector<infill::LookedAtLayer> seen;
  for (std::size_t i = 0; i < layers; ++i) {
    infill::fill_sparse(sparse.front(),
                        {.pattern = pattern,
                         .density = density,
                         .band = 420,
                         .angle_rad = degrees(45),
                         .connect = joined,
                         .z = static_cast<Um>(200 * (i + 1)),
                         .turn = i,
                         .reach = 30'000},
                        beads[i]);
    seen.push_back({200, &outline, &sparse, &beads[i]});
  }
  InfillSettings settings;
  settings.infill_pattern = pattern;
  return infill::figures_of(settings, seen, [](std::size_t count, const auto& of_layer) {
    for (std::size_t i = 0; i < count; ++i) of_layer(i);
  });
}

}  // namespace

TEST_CASE("figures: density and directions of patterns that are known", "[infill][law]") {
  const infill::Figures grid = figures(InfillPattern::grid, 0.2);
  CHECK(grid.density() == Approx(0.2).epsilon(0.005));
  CHECK(grid.density_spread == Approx(0).margin(1e-6));
  CHECK(grid.fabric[0] == Approx(0).margin(0.02));
  CHECK(grid.fabric[1] == Approx(1).margin(0.02));
  const infill::Figures triangles = figures(InfillPattern::triangles, 0.2);
  CHECK(triangles.fabric[0] == Approx(0).margin(0.03));
  CHECK(triangles.fabric[1] == Approx(0).margin(0.03));
  CHECK(triangles.fabric[2] == Approx(1).margin(0.02));
  CHECK(figures(InfillPattern::aligned, 0.2).fabric[0] == Approx(1).margin(0.02));
  // a density whose period is 20 layers: two of them in the block
  CHECK(figures(InfillPattern::gyroid, 0.25814).fabric[0] <= 0.02);
}

TEST_CASE("figures: what lies on nothing", "[infill]") {
  // lines cross those below at one place a pitch: all but a width of each 2.1 mm is free
  const infill::Figures lines = figures(InfillPattern::lines, 0.2);
  CHECK(lines.over_air_mm / lines.looked_mm == Approx(0.8).margin(0.06));
  const infill::Figures grid = figures(InfillPattern::grid, 0.2);
  CHECK(grid.over_air_mm / grid.looked_mm <= 0.01);
}

TEST_CASE("figures: Hilbert's curve is local and fills the plane, parallel lines are not and do", "[infill]") {
  const infill::Figures hilbert = figures(InfillPattern::hilbert, 0.2);
  CHECK(hilbert.locality <= 8);  // 6 for whole cells; ends of steps are half a cell off
  CHECK(hilbert.locality >= 3);
  CHECK(hilbert.box_dimension == Approx(2).margin(0.35));  // boxes that the edge cuts count whole
  CHECK(figures(InfillPattern::lines, 0.2).locality > 15);
}

TEST_CASE("figures: bounds by density", "[infill]") {
  const infill::Bounds triangles = infill::bounds_of(InfillPattern::triangles, 0.3);
  CHECK(triangles.stiffness_plane == Approx(0.1));
  CHECK(triangles.stiffness_z == Approx(0.3));
  CHECK(triangles.conductivity_z == Approx(0.3));
  CHECK(triangles.conductivity_plane == Approx(0.3 / 1.7));
  const infill::Bounds honeycomb = infill::bounds_of(InfillPattern::honeycomb, 0.2);
  CHECK(honeycomb.stiffness_plane == Approx(1.5 * 0.008));
  const infill::Bounds gyroid = infill::bounds_of(InfillPattern::gyroid, 0.2);
  CHECK(gyroid.stiffness_z == Approx(0.04));
  CHECK(gyroid.conductivity_plane == Approx(0.4 / 2.8));
  for (const auto& choice : choices_of(InfillPattern{})) {
    const infill::Bounds b = infill::bounds_of(choice.value, 1);
    CHECK(b.stiffness_plane <= 1);
    CHECK(b.conductivity_plane == Approx(1));
  }
}
