// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/groups/machine.h"

#include "core/error.h"
#include "profile/profile.h"

#include <catch2/catch.hpp>

using namespace weft;

TEST_CASE("machine: the print surface is counter-clockwise whatever its shape", "[settings]") {
  MachineSettings machine;
  CHECK(print_surface(machine) == Ring{{0, 0}, {220000, 0}, {220000, 220000}, {0, 220000}});
  machine.machine_center_is_zero = true;
  CHECK(print_surface(machine).front() == Point{-110000, -110000});
  machine.bed_shape = BedShape::polygon;
  machine.bed_polygon = {{0, 0}, {0, 100000}, {100000, 0}};
  CHECK(double_area(print_surface(machine)) > 0);
}

TEST_CASE("machine: a round bed becomes a polygon within five microns of the circle", "[settings]") {
  MachineSettings machine;
  machine.bed_shape = BedShape::circle;
  const Ring ring = print_surface(machine);
  const Point centre{110000, 110000};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i], b = ring[(i + 1) % ring.size()];
    CHECK(distance(a, centre) == Approx(110000).margin(1));
    CHECK(distance(lerp(a, b, 0.5), centre) > 110000 - 7);
  }
  CHECK(is_simple(ring));
}

TEST_CASE("machine: the reach is a box from two corners, a polygon, or the print surface", "[settings]") {
  MachineSettings machine;
  CHECK(reach_area(machine) == print_surface(machine));
  machine.machine_reach = {{230000, 225000}, {-5000, -10000}};
  CHECK(reach_area(machine) == Ring{{-5000, -10000}, {230000, -10000}, {230000, 225000}, {-5000, 225000}});
  CHECK(reach_z_max(machine) == machine.machine_height);
}

TEST_CASE("machine: a ring that crosses, touches or doubles back on itself is not simple", "[settings]") {
  CHECK(is_simple({{0, 0}, {10, 0}, {10, 10}, {5, 3}, {0, 10}}));
  CHECK_FALSE(is_simple({{0, 0}, {10, 10}, {10, 0}, {0, 10}}));
  CHECK_FALSE(is_simple({{0, 0}, {10, 0}, {10, 10}, {5, 0}, {0, 10}}));
  CHECK_FALSE(is_simple({{0, 0}, {10, 0}, {5, 0}, {5, 10}}));
}

TEST_CASE("machine: areas that enclose nothing are refused with their key", "[settings]") {
  const auto refused = [](const char* key, const char* text) {
    Profile profile;
    apply_value(profile, key, text, "--set");
    REQUIRE_THROWS_WITH(check_consistency(profile), Catch::Contains(key));
  };
  refused("bed_exclude_areas", "0x0, 10x10, 10x0, 0x10");
  refused("machine_reach", "0x0, 10x10, 20x20");
  refused("machine_reach", "5x5");
  refused("home_position", "0x0, 1x1");
  refused("macro_position", "0x0, 1x1");
  refused("machine_reach_z_min", "900");
}
