// SPDX-License-Identifier: GPL-3.0-or-later
#include "areas.h"
#include "infill/infill.h"
#include "model/flow.h"

#include <algorithm>
#include <cmath>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;
using infill::FillInput;
using infill::LayerAreas;

namespace {

LayerAreas top_and_solid() {
  LayerAreas areas(1);
  areas[0].top.push_back(rectangle(0, 0, 20000, 10000));
  areas[0].solid.push_back(rectangle(20000, 0, 30000, 10000));
  return areas;
}
Beads ironing(const ShellSettings& shells, bool topmost = false) {
  const LayerAreas areas = top_and_solid();
  auto beads = infill::fill({}, shells,
                            {.areas = areas, .index = 4, .z = 1000, .height = 200, .nozzle = 400, .topmost = topmost})
                   .beads;
  std::erase_if(beads, [](const Bead& bead) { return bead.role != Role::ironing; });
  return beads;
}
double volume(const Beads& beads) {
  double mm3 = 0;
  for (const Bead& bead : beads) mm3 += volume_mm3(bead, 200);
  return mm3;
}
ShellSettings ironed() {
  ShellSettings shells;
  shells.ironing_enabled = true;
  return shells;
}

}  // namespace

TEST_CASE("infill: ironing goes over top surfaces closely, off their edge, and adds the share that is asked for",
          "[infill]") {
  CHECK(ironing({}).empty());
  const auto beads = ironing(ironed());
  REQUIRE_FALSE(beads.empty());
  // 0.2 mm, half a nozzle, off all sides; 15 % of 0.2 mm. Turns at the edge lack some of it: 2 %.
  CHECK(volume(beads) == Approx(19.6 * 9.6 * 0.2 * 0.15).epsilon(0.02));
  for (const Bead& bead : beads)
    for (const auto& j : bead.path) {
      CHECK((j.at.x >= 200 && j.at.x <= 19800 && j.at.y >= 200 && j.at.y <= 9800));
      CHECK(static_cast<double>(j.flow) == Approx(0.15));
      CHECK(j.width == Approx(100).margin(3));  // whole lines fill the area
    }
  CHECK(beads.front().sequence != 0);
  ShellSettings wide = ironed();
  wide.ironing_inset = 2_mm, wide.ironing_flow = 30;
  CHECK(volume(ironing(wide)) == Approx(16 * 6 * 0.2 * 0.3).epsilon(0.02));
}

TEST_CASE("infill: what is ironed, and in which direction", "[infill]") {
  ShellSettings shells = ironed();
  const double top = volume(ironing(shells));
  shells.ironing_surfaces = IroningSurfaces::topmost;
  CHECK(ironing(shells).empty());
  CHECK(volume(ironing(shells, true)) == Approx(top));
  shells.ironing_surfaces = IroningSurfaces::solid;
  CHECK(volume(ironing(shells)) == Approx(29.6 * 9.6 * 0.2 * 0.15).epsilon(0.02));
  // The longest pieces run as they are asked to; by themselves across the lines of the top.
  const auto along_x = [](const Beads& beads) {
    double x = 0, y = 0;
    for (const Bead& bead : beads)
      for (std::size_t i = 1; i < bead.path.size(); ++i) {
        x += std::abs(bead.path[i].at.x - bead.path[i - 1].at.x);
        y += std::abs(bead.path[i].at.y - bead.path[i - 1].at.y);
      }
    return x > y;
  };
  shells.ironing_surfaces = IroningSurfaces::top;
  shells.skin_angle = 0;
  CHECK_FALSE(along_x(ironing(shells)));
  shells.skin_angle = 90;
  CHECK(along_x(ironing(shells)));
  shells.ironing_angle = 90;
  CHECK_FALSE(along_x(ironing(shells)));
}

TEST_CASE("infill: ironing goes up to what stands on a top surface, and not below it", "[infill]") {
  const LayerAreas areas = top_and_solid();
  const Regions letter{rectangle(5000, 3000, 9000, 7000)}, hair{rectangle(15000, 3000, 15300, 7000)};
  const auto ironed_mm2 = [&](const Regions* above, IroningSurfaces surfaces) {
    ShellSettings shells = ironed();
    shells.ironing_surfaces = surfaces;
    auto beads =
        infill::fill({}, shells, {.areas = areas, .index = 4, .z = 1000, .height = 200, .nozzle = 400, .above = above})
            .beads;
    std::erase_if(beads, [](const Bead& bead) { return bead.role != Role::ironing; });
    if (above == &letter && surfaces == IroningSurfaces::top)
      for (const Bead& bead : beads)
        for (const auto& j : bead.path) CHECK_FALSE(holds({rectangle(5060, 3060, 8940, 6940)}, j.at));
    return volume(beads) / (0.2 * 0.15);
  };
  const double bare = ironed_mm2(nullptr, IroningSurfaces::top);
  CHECK(bare - ironed_mm2(&letter, IroningSurfaces::top) == Approx(16).epsilon(0.05));
  CHECK(ironed_mm2(&hair, IroningSurfaces::top) == Approx(bare).epsilon(0.002));  // less than a nozzle wide
  CHECK(ironed_mm2(&letter, IroningSurfaces::solid) > bare);
}
