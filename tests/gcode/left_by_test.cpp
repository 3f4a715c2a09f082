// SPDX-License-Identifier: GPL-3.0-or-later
#include "gcode/left_by.h"

#include "gcode/writer.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::gcode;

namespace {

/// The first layer of a line that begins at (5, 5), after that start G-code.
std::string first_layer(const std::string& start) {
  Settings settings;
  settings.retraction.retraction_amount = 800;
  settings.gcode.machine_start_gcode = start;
  Extrude line{.path = {{{5000, 5000}, 400, 1.F}, {{9000, 5000}, 400, 1.F}}, .height = 200, .speed_mm_s = 30};
  Travel travel{.path = {{5000, 5000, 200}}};
  travel.speed_mm_s = 150, travel.z_speed_mm_s = 10;
  PrintPlan plan;
  plan.layers.push_back({.z = 200, .height = 200, .steps = {Retract{}, travel, Prime{}, line}});
  Statistics statistics;
  statistics.layer_s = {10};
  return Writer({settings, plan, statistics, "part", {}}).layer(0);
}

std::size_t place(const std::string& text, const char* what) {
  const auto at = text.find(what);
  INFO(text << "\nhas no " << what);
  CHECK(at != std::string::npos);
  return at;
}

}  // namespace

TEST_CASE("gcode: what start G-code leaves is read from its moves", "[gcode]") {
  struct Row {
    const char* code;
    std::optional<Um> z;
    double drawn_mm;
  };
  for (const Row& row : {
           Row{"", std::nullopt, 0},
           Row{"G28\n", 0, 0},
           Row{"G28 X Y\n", std::nullopt, 0},
           Row{"G28 ; home\nG1 Z5 F600\nM83\nG1 X9 E15\nG1 Z2\n", 2000, 0},
           Row{"g28\nG91\nG0 Z1.5\nG0 Z1.5\nG90\n", 3000, 0},
           Row{"G28\nM83\nG1 E10\nG1 E-3\nG1 E1\n", 0, 2},
           Row{"G28\nM82\nG92 E0\nG1 E10\nG1 E9.2\nG92 E0\n", 0, 0.8},
           Row{"G28\nG29\n", std::nullopt, 0},
           Row{"G28\nPRINT_START BED=60 Z=3\n", std::nullopt, 0},
           Row{"G28\nM117 Z9 E-4 is on its way\nG4 P10\n", 0, 0},
       }) {
    CAPTURE(row.code);
    const auto left = left_by(row.code);
    CHECK(left.z == row.z);
    CHECK(left.drawn_mm == Approx(row.drawn_mm).margin(1e-9));
  }
  CHECK(left_by("G10\n").by_firmware);
  CHECK_FALSE(left_by("G10\nG11\n").by_firmware);
  CHECK_FALSE(left_by("G10 P0 S200\n").by_firmware);  // a temperature
}

TEST_CASE("gcode: the first travel goes up before it goes across the bed, and down when it is there", "[gcode]") {
  for (const char* below : {"G28", "PRINT_START", "G28\nG1 Z.1"}) {
    const auto text = first_layer(below);
    CHECK(place(text, "G0 Z.2 F600\n") < place(text, "G0 X5 Y5 F9000\n"));
  }
  const auto above = first_layer("G28\nG1 Z5");
  CHECK(place(above, "G0 X5 Y5 F9000\n") < place(above, "G0 Z.2 F600\n"));
  CHECK(first_layer("G28\nG1 Z.2").find("G0 Z") == std::string::npos);
}

TEST_CASE("gcode: the first travel is retracted once, and what was drawn back is pushed forward", "[gcode]") {
  const auto own = first_layer("G28");
  CHECK(place(own, "G1 E-.8") < place(own, "G0 X5"));
  CHECK(place(own, "G0 X5") < place(own, "G1 E.8"));
  const auto theirs = first_layer("G28\nM83\nG1 E10\nG1 E-3");
  CHECK(theirs.find("E-") == std::string::npos);
  CHECK(place(theirs, "G0 X5") < place(theirs, "G1 E3"));
}
