// SPDX-License-Identifier: GPL-3.0-or-later
// What weft's dialects write beside moves: no such command may make the audit lose the nozzle.
#include "audit/audit_fixture.h"

namespace weft::audit {

TEST_CASE("audit: limits, accelerations, heaters and progress of every firmware leave the position known", "[audit]") {
  const Bench bench;
  for (const auto* line : {"M201 X3000 Y3000 Z100 E5000",
                           "M202 X3000 Y3000",
                           "M203 X300 Y300 Z12.5 E60",
                           "M204 S1000",
                           "M204 P1000",
                           "M204 T3000",
                           "M205 X8",
                           "M205 X8 Y8",
                           "M205 J0.013",
                           "M207 X8",
                           "M566 X480 Y480",
                           "SET_VELOCITY_LIMIT ACCEL=3000",
                           "M73 P12 R34",
                           "M141 S45",
                           "M191 S45",
                           "M140 S60",
                           "M190 S60",
                           "M104 S210",
                           "M109 S210",
                           "M106 S0.5",
                           "M106 S128",
                           "M107",
                           "M486 S0",
                           "M486 S-1",
                           ";MESH:part_stl",
                           ";LAYER:3",
                           ";TYPE:WALL-OUTER",
                           ";TIME_ELAPSED:12.5",
                           "; EXECUTABLE_BLOCK_START",
                           ";TYPE:Outer wall"}) {
    INFO(line);
    const auto report = bench.moves(std::string(line) + "\nG1 X60 Y60\n");
    CHECK(report.clean());
    CHECK(report.opaque_count == 0);
    CHECK(report.unaudited_moves == 0);
  }
}

TEST_CASE("audit: features are told in the words of each comment dialect, what a person wrote too", "[audit]") {
  const Bench bench;
  const auto feature_of = [&](const std::string& before) {
    const auto report = bench(before + "G28\nG1 X300 Y100 F1800\n");
    return report.findings.empty() ? std::string("none") : std::string(report.findings[0].feature);
  };
  CHECK(feature_of(";LAYER:0\n;TYPE:WALL-OUTER\n") == "outer_wall");
  CHECK(feature_of(";LAYER:0\n;TYPE:SKIRT\n; brim\n") == "brim");
  CHECK(feature_of(";LAYER:0\n;TYPE:SKIN\n; overhang\n") == "overhang_skin");
  CHECK(feature_of(";LAYER:0\n;TYPE:CUSTOM\n") == "custom");
  CHECK(feature_of(";LAYER_CHANGE\n;TYPE:Outer wall\n") == "outer_wall");
  CHECK(feature_of(";LAYER_CHANGE\n;TYPE:Brim\n") == "brim");
  CHECK(feature_of(";LAYER_CHANGE\n;TYPE:External perimeter\n") == "outer_wall");
  CHECK(feature_of(";LAYER_CHANGE\n;TYPE:Custom\n") == "custom");
}

}  // namespace weft::audit
