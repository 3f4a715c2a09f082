// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/flow.h"

#include "model/bead.h"

#include <catch2/catch.hpp>

using namespace weft;

TEST_CASE("flow: a bead of 0.45 by 0.2 mm holds what the Slic3r manual says") {
  CHECK(flow::area_mm2(0.45, 0.2) == Approx(0.2 * 0.25 + 3.14159265 * 0.01));
  CHECK(flow::spacing_mm(0.45, 0.2) == Approx(0.45 - 0.2 * 0.2146018));
  CHECK(flow::spacing_mm(0.45, 0.2, 0.0) == Approx(0.45));
}

TEST_CASE("flow: a bead narrower than high is a rectangle") {
  CHECK(flow::area_mm2(0.1, 0.2) == Approx(0.02));
}

TEST_CASE("flow: band times height is the area, and line_width undoes band") {
  const Um width = GENERATE(450, 200, 600, 1000, 120), height = GENERATE(100, 200, 300);
  const Um band = flow::band(width, height);
  CHECK(to_mm(band) * to_mm(height) == Approx(flow::area_mm2(to_mm(width), to_mm(height))).epsilon(0.01));
  CHECK(std::abs(flow::line_width(band, height) - width) <= 1);
}

TEST_CASE("flow: automatic widths keep the strand's cross-section, within the cap") {
  CHECK(flow::automatic_outer_width(400) == 420);
  CHECK(flow::area_mm2(to_mm(flow::automatic_width(400, 200, false)), 0.2) ==
        Approx(flow::bridge_area_mm2(400)).epsilon(0.002));
  CHECK(flow::automatic_width(400, 100) == 680);
}

TEST_CASE("flow: a bridge strand's flow gives it the nozzle's circle") {
  CHECK(to_mm(400) * 0.2 * flow::bridge_flow(400, 200) == Approx(3.14159265 / 4 * 0.16));
}

TEST_CASE("bead: doubled flow is doubled volume, and width and flow vary linearly") {
  Bead bead{{{{0, 0}, 400, 1.F}, {{10000, 0}, 400, 1.F}}, Role::infill};
  CHECK(volume_mm3(bead, 200) == Approx(10 * 0.4 * 0.2));
  for (auto& j : bead.path) j.flow *= 2;
  CHECK(volume_mm3(bead, 200) == Approx(2 * 10 * 0.4 * 0.2));
  const Bead wedge{{{{0, 0}, 0, 1.F}, {{10000, 0}, 400, 1.F}}, Role::infill};
  CHECK(volume_mm3(wedge, 200) == Approx(10 * 0.2 * 0.2));
}
