// SPDX-License-Identifier: GPL-3.0-or-later
// What the audit's reader makes of commands, dialects and damaged files.
#include "audit/audit_fixture.h"
#include "audit/scan.h"

#include <fmt/format.h>

namespace weft::audit {

TEST_CASE("audit: a move from where a macro left the nozzle is taken to start anywhere in the reach", "[audit]") {
  Bench bench;
  const std::string print = "PRINT_START BED=60\nG1 Z5\nG1 X10\nG1 Y10\nG1 X20\n";
  const auto report = bench.moves(print);
  CHECK(report.verdict == Verdict::pass);
  CHECK(report.checked_moves == 5);
  REQUIRE(report.opaque.size() == 1);
  CHECK(report.opaque[0].name == "PRINT_START");
  CHECK(report.opaque[0].first_line == 7);
  CHECK(header_value(report) == "pass, 5 moves checked; opaque: PRINT_START");
  // Where the reach is not convex, or holds a no-go area, the way from there is not known.
  bench.machine.bed_exclude_areas = {{{90_mm, 40_mm}, {110_mm, 40_mm}, {110_mm, 60_mm}}};
  const auto between = bench.moves(print);
  CHECK(between.verdict == Verdict::unaudited);
  CHECK(between.unaudited_moves == 2);  // along X, then along Y; the last is known
  REQUIRE(between.unaudited.size() == 1);
  CHECK(between.unaudited[0].cause.command == "PRINT_START");
  CHECK(between.unaudited[0].cause.line == 7);
  CHECK(between.unaudited[0].count == 2);
  CHECK_THAT(remedy(between), Catch::Contains("macro_position"));
  bench.machine.macro_position = Ring{{100_mm, 5_mm}};
  CHECK(bench.moves(print).clean());
  CHECK(bench.moves("PRINT_START\nG1 X100 Y90\n").findings.at(0).kind == Finding::Kind::no_go);
  // High above the area it does not matter.
  bench.machine.macro_position.reset();
  bench.machine.exclude_height = 10_mm;
  bench.machine.macro_z = 20_mm;
  CHECK(bench.moves("PRINT_START\nG1 X100 Y90\n").clean());
}

TEST_CASE("audit: a bead, an arc or a relative move from an unknown place is not audited", "[audit]") {
  const Bench bench;
  CHECK(bench.moves("PRINT_START\nG1 X10 Y10 E1\n").verdict == Verdict::unaudited);
  CHECK(bench.moves("PRINT_START\nG2 X10 Y10 R100\n").verdict == Verdict::unaudited);
  CHECK(bench.moves("PRINT_START\nG91\nG1 X10\n").verdict == Verdict::unaudited);
  CHECK(bench.moves("PRINT_START\nG91\nG1 Z10\n").verdict == Verdict::unaudited);
  CHECK(bench.moves("PRINT_START\nG91\nG1 Z10\nG90\nG1 X5 Y5 Z5\n").unaudited_moves == 1);
}

TEST_CASE("audit: a raise off the bed before homing is what it is, a high one, and one after homing, are not audited",
          "[audit]") {
  const Bench bench;
  CHECK(bench("G91\nG1 Z5 F600\nG90\nG28\nG1 X10 Y10 Z5\n").clean());
  CHECK(bench("G91\nG1 Z21 F600\nG90\nG28\nG1 X10 Y10 Z5\n").verdict == Verdict::unaudited);
  CHECK(bench("G91\nG1 Z15\nG1 Z15\nG90\nG28\nG1 X10 Y10 Z5\n").unaudited_moves == 1);
  CHECK(bench("G91\nG1 Z-5\nG90\nG28\nG1 X10 Y10 Z5\n").verdict == Verdict::unaudited);
  CHECK(bench("G28\nG91\nG1 Z5\nG90\nG1 X10 Y10 Z5\n").verdict == Verdict::unaudited);
  Bench low;
  low.machine.home_z = 0;
  CHECK(low("G28\nG91\nG1 Z5\nG90\nG1 X10 Y10 Z5\n").clean());
}

TEST_CASE("audit: where only one coordinate is known, what lies beyond the reach altogether is found", "[audit]") {
  const Bench bench;
  const auto report = bench.moves("G29\nG1 Y-3\n");
  REQUIRE(report.violation_count == 1);
  CHECK(report.findings[0].side == Side::minus_y);
  CHECK(report.unaudited_moves == 0);
  Bench round;
  round.machine.bed_shape = BedShape::circle;  // what Y lets X be is not known
  CHECK(round.moves("G29\nG1 Y100\n").verdict == Verdict::unaudited);
}

TEST_CASE("audit: without a home position the first move after homing starts anywhere in the reach", "[audit]") {
  Bench bench;
  bench.machine.home_position.reset();
  CHECK(bench("G28\nG1 X100 Y100\nG1 X120 Y100\n").clean());
  CHECK(bench("G28\nG1 X300 Y100\n").violation_count == 1);
  bench.machine.bed_shape = BedShape::polygon;  // an L
  bench.machine.bed_polygon = {{0, 0}, {200_mm, 0}, {200_mm, 100_mm}, {100_mm, 100_mm}, {100_mm, 200_mm}, {0, 200_mm}};
  const auto report = bench("G28\nG1 X150 Y50\nG1 X120 Y50\n");
  CHECK(report.verdict == Verdict::unaudited);
  CHECK_THAT(remedy(report), Catch::Contains("home_position"));
}

TEST_CASE("audit: the whole way of the first move after homing is judged", "[audit]") {
  Bench bench;
  bench.machine.bed_shape = BedShape::polygon;  // an L
  bench.machine.bed_polygon = {{0, 0}, {200_mm, 0}, {200_mm, 100_mm}, {100_mm, 100_mm}, {100_mm, 200_mm}, {0, 200_mm}};
  bench.machine.home_position = Ring{{10_mm, 190_mm}};
  const auto across = bench("G28\nG1 Z5\nG1 X190 Y50\n");
  REQUIRE(across.violation_count == 1);
  CHECK(across.findings[0].line == 3);
  CHECK(across.findings[0].outside > 10000);
  CHECK(bench("G28\nG1 X10 Y50\nG1 X190 Y50\n").clean());
  // A switch outside: the way in is the machine's, what leaves again is not.
  bench.machine.home_position = Ring{{-5_mm, 190_mm}};
  CHECK(bench("G28\nG1 Z5\nG1 X10 Y50\n").clean());
  CHECK(bench("G28\nG1 Z5\nG1 X190 Y50\n").violation_count == 1);
}

TEST_CASE("audit: G10 and G11 retract, tool offsets count when the tool is used, workspaces where they are known",
          "[audit]") {
  Bench bench;
  CHECK(bench.moves("G10\nG1 X50\nG11\nG10 S1\nG10 P0 S200 R150\nG10 P1 X10 Y5\nG1 X60\n").clean());
  CHECK(bench.moves("G10 P1 X10 Y5\nT1\nG1 X60 Y50\n").verdict == Verdict::unaudited);
  CHECK(bench.moves("G10 P1 X10 Y5\nT1\nG1 X60 Y50\nT0\nG1 X60 Y50\n").unaudited_moves == 1);
  CHECK(bench.moves("G10 L2 P1 X10\nG1 X50 Y50\n").verdict == Verdict::unaudited);
  CHECK(bench.moves("G55\nG28\nG1 X50 Y50\n").verdict == Verdict::unaudited);
  CHECK(bench.moves("M206 X5\nG1 X50 Y50\nG1 X300 Y50\n").unaudited_moves == 2);
  bench.machine.firmware = Firmware::reprapfirmware;
  CHECK(bench.moves("G10 L2 P1 X10\nG1 X190 Y50\n").clean());
  CHECK(bench.moves("G10 L2 P1 X10\nG1 X191 Y50\n").violation_count == 1);
  CHECK(bench.moves("G10 L2 P2 X10 Y0 Z0\nG1 X191 Y50\nG55\nG1 X190\nG54\nG1 X200\n").clean());
  CHECK(bench.moves("G10 L2 P2 X10 Y0 Z0\nG55\nG28\nG1 X191 Y50\n").violation_count == 1);
  CHECK(bench.moves("G10 L20 P1 X0\nG1 X100\n").clean());
  CHECK(bench.moves("G10 L20 P1 X0\nG1 X101\n").violation_count == 1);
  CHECK(bench.moves("G59.1\nG1 X50\n").verdict == Verdict::unaudited);
}

TEST_CASE("audit: arcs in upright planes are judged as the curves they are", "[audit]") {
  const Bench bench;
  CHECK(bench.moves("G18\nG3 X110 Z0.2 I5 K0\nG17\nG1 X120\n").clean());  // over the top
  CHECK(bench.moves("G18\nG2 X110 Z0.2 I5 K0\n").violation_count == 1);   // through the bed
  CHECK(bench.moves("G18\nG2 X110 Z0.2 I5 K0\n").findings.at(0).outside == Approx(4800).margin(2));
  CHECK(bench.moves("G19\nG3 Y110 Z0.2 J5 K0\n").findings.at(0).side == Side::minus_z);
  CHECK(bench.moves("G1 Z50\nG18\nG2 X110 Z50 R5\n").checked_moves == 3);
  CHECK(bench.moves("G1 X190 Z50\nG18\nG2 X190 Z50 I5.1 K0\n").violation_count == 1);  // a full circle
  CHECK(bench.moves("G1 X190 Z50\nG18\nG2 X190 Z50 I5 K0\n").clean());
  Bench klipper;
  klipper.machine.firmware = Firmware::klipper;  // looks from the other side
  CHECK(klipper.moves("G18\nG2 X110 Z0.2 I5 K0\n").clean() != bench.moves("G18\nG2 X110 Z0.2 I5 K0\n").clean());
}

TEST_CASE("audit: splines are judged by where they lead", "[audit]") {
  const Bench bench;
  CHECK(bench.moves("G1 X190 Y50\nG5 X190 Y150 I13 J0 P13 Q0\n").clean());  // bulges to 199.75
  const auto out = bench.moves("G1 X190 Y50\nG5 X190 Y150 I14 J0 P14 Q0\n");
  REQUIRE(out.violation_count == 1);
  CHECK(out.findings[0].outside == Approx(500).margin(2));
  CHECK(out.checked_moves == 3);
  CHECK(bench.moves("G1 X190 Y50\nG5.1 X190 Y150 I20 J50\n").clean());
  CHECK(bench.moves("G1 X190 Y50\nG5.1 X190 Y150 I20.1 J50\n").violation_count == 1);
  CHECK(bench.moves("G5 X190 Y150 P1 Q1\n").verdict == Verdict::unaudited);
  CHECK(bench.moves("G5.2 X190 Y150 P1 Q1\n").verdict == Verdict::unaudited);
}

TEST_CASE("audit: the start G-code of a Bambu printer is read without a false finding", "[audit]") {
  Bench bench;
  bench.machine.machine_width = bench.machine.machine_depth = 350_mm;
  bench.machine.machine_reach = {{-10_mm, -10_mm}, {350_mm, 350_mm}};
  const auto report = bench(
      "; FEATURE: Custom\nM1006 A53 B9 L99 C53 D9 M99 E53 F9 N99\nM73.2   R1.0 ;Reset left time magnitude\nG28.140 D0; "
      "reset\n"
      "G91\nG380 S2 Z42 F1200\nG90\n    M104 S140 A\nM1002 set_filament_type:PETG\nG28 X T300\nG150.1 F18000\nG1 X175 "
      "Y160 F30000\n"
      "G28 Z P0 T250\nM620 S0A H-1 ; switch material\nT0 H-1\nM621 S0A\nM620.11 S1 L0 I0 B-1 R10 D8 E-10 "
      "F299.339\nM622 J1\n"
      "    G29 A1 O X160.193 Y152.193 I25.8066 J17.1131 R\nM623\n    M970.3 Q1 A5 K0 O1\nG29.1 Z-0.02 ; for Textured "
      "PEI Plate\n"
      "    G1 Z5 F1200\n    G1 X270 Y-0.5 F60000\n    G91\n    G3 Z0.4 I1.217 J0 P1 F60000\n    G90\n; "
      "MACHINE_START_GCODE_END\n"
      "; CHANGE_LAYER\n; Z_HEIGHT: 0.2\n; LAYER_HEIGHT: 0.2\nG1 E-.8 F1800\n; OBJECT_ID: 15\nG1 X161.372 Y153.574 "
      "F60000\nG1 Z.2\n"
      "; FEATURE: Brim\n; LINE_WIDTH: 0.5\nG1 X161.788 Y153.19 E.02045\nG1 X361 Y153 E1\n");
  REQUIRE(report.violation_count == 1);
  CHECK(report.findings[0].feature == "brim");
  CHECK(report.findings[0].object == "15");
  CHECK(report.opaque_count > 3);
}

TEST_CASE("audit: Klipper's offsets and saved states are followed", "[audit]") {
  const Bench bench;
  CHECK(bench.moves("SET_GCODE_OFFSET X=10\nG1 X190\n").clean());
  CHECK(bench.moves("SET_GCODE_OFFSET X=10\nG1 X191\n").violation_count == 1);
  CHECK(bench.moves("SET_GCODE_OFFSET X_ADJUST=10\nSET_GCODE_OFFSET X=0\nG1 X199\n").clean());
  CHECK(bench.moves("SAVE_GCODE_STATE NAME=a\nG91\nG1 X5\nRESTORE_GCODE_STATE NAME=a\nG1 X150\n").clean());
  CHECK(bench.moves("RESTORE_GCODE_STATE NAME=never\nG1 X150\n").verdict == Verdict::unaudited);
  CHECK(bench
            .moves("SET_VELOCITY_LIMIT ACCEL=3000\nSET_PRESSURE_ADVANCE ADVANCE=0.05\nEXCLUDE_OBJECT_DEFINE NAME=a "
                   "CENTER=50,50 "
                   "POLYGON=[[40,40],[50,60]]\nG1 X10\n")
            .opaque_count == 0);
}

TEST_CASE("audit: features, layers and objects are read in the dialects of PrusaSlicer, Orca, Bambu and Cura",
          "[audit]") {
  const Bench bench;
  const auto finding = [&](std::string_view lines) {
    const auto report = bench(fmt::format("G28\nM83\nG1 X10 Y10 Z0.2\n{}G1 X201 Y10 E1\n", lines));
    REQUIRE(report.findings.size() == 1);
    return report.findings[0];
  };
  const auto prusa = finding(";LAYER_CHANGE\n; printing object Cube.stl id:0 copy 0\n;TYPE:Skirt/Brim\n");
  CHECK(prusa.feature == "skirt");
  CHECK(prusa.object == "Cube.stl");
  CHECK(prusa.layer == 0);
  const auto orca = finding(";LAYER_CHANGE\n;LAYER_CHANGE\nEXCLUDE_OBJECT_START NAME=part_0\n;TYPE:Outer wall\n");
  CHECK(orca.feature == "outer_wall");
  CHECK(orca.object == "part_0");
  CHECK(orca.layer == 1);
  const auto bambu = finding(
      "; CHANGE_LAYER\n; Z_HEIGHT: 0.2\n; LAYER_HEIGHT: 0.2\n; start printing object, unique label id: 15\n; FEATURE: "
      "Sparse infill\n; LINE_WIDTH: 0.5\n");
  CHECK(bambu.feature == "infill");
  CHECK(bambu.object == "15");
  CHECK(bambu.outside == 1229);
  const auto cura = finding(";LAYER_COUNT:3\n;LAYER:2\n;MESH:part.stl\n;TYPE:WALL-INNER\n");
  CHECK(cura.feature == "inner_wall");
  CHECK(cura.object == "part.stl");
  CHECK(cura.layer == 2);
  CHECK(finding("; BEGIN_LAYER_OBJECT z=0.2\n;; --- layer 1 (0.2 @ 0.4) ---\n").layer == 1);
  const auto marlin = finding(";LAYER_CHANGE\nM486 S2\nM486 A\"bracket\"\n;TYPE:Something new\n");
  // Names that are given once, at the head, hold where their number comes again.
  const auto again =
      finding("M486 T2\nM486 S0\nM486 Abox_1\nM486 S1\nM486 Abox_2\nM486 S-1\n;LAYER_CHANGE\nM486 S0\n;TYPE:Skirt\n");
  CHECK(again.object == "box_1");
  CHECK(marlin.feature == "something new");
  CHECK(marlin.object == "bracket");
}

TEST_CASE("audit: G-code before the first and after the last layer is custom", "[audit]") {
  const Bench bench;
  const std::string cura =
      ";FLAVOR:Marlin\n;LAYER_COUNT:1\nG28\nM83\nG1 X-3 Y10 Z0.2\nG1 X10 E3\n;LAYER:0\n;TYPE:SKIRT\nG1 X20 "
      "E1\n;TIME_ELAPSED:9\nG91\nG1 Z10\nG90\nG1 X0 Y205\n;End of Gcode\n";
  const auto report = bench(cura);
  REQUIRE(report.findings.size() == 3);
  for (const auto& f : report.findings) CHECK(f.feature == "custom");
}

TEST_CASE("audit: a file without a slicer's comments is held against the print surface throughout", "[audit]") {
  Bench bench;
  bench.machine.machine_reach = {{-10_mm, -10_mm}, {210_mm, 210_mm}};
  const std::string plain = "G28\nM83\nG1 X10 Y10 Z0.2\nG1 X205 Y10 E8\n";
  REQUIRE(bench(plain).violation_count == 1);
  CHECK(bench(plain).findings[0].feature.empty());
  CHECK(bench(plain + ";TYPE:Perimeter\nG1 X10 Y10\n").clean());  // it was start G-code
  CHECK(bench(plain).notices.size() == 1);
}

TEST_CASE("audit: damaged lines are found with their number and their reason", "[audit]") {
  const Bench bench;
  using namespace std::string_literals;
  struct Case {
    std::string line, reason;
  };
  const Case cases[] = {
      {"G1 X1.2.3 Y4", "malformed number"},
      {"G1 X--5", "malformed number"},
      {"G1 X Y5", "malformed number"},
      {"G1 X1,5", "malformed word"},
      {"G1 X5-3", "malformed number"},
      {"G1 Xnan", "malformed number"},
      {"G1 X10 X20", "twice"},
      {"G1 X{x_max}", "malformed number"},
      {"G1 X1\0Y2"s, "NUL"},
      {"\0\0\0"s, "NUL"},
      {"; a comment with \0"s, "NUL"},
      {"M104 S{temperature}", "placeholder"},
      {"{if x}", "placeholder"},
      {"G1 X10 Y10*1", "checksum"},
      {"N5 M104 S200*1", "checksum"},
      {"G2 X10 Y10", "centre or radius"},
      {"G2 X150 Y100 R5", "does not span"},
      {"G2 X50 Y101 I10 J0", "another radius"},
      {"G2 R5", "an end"},
      {"?\x7f\xff", "not a command"},
      {"G1 X10 Y\xc3\xa9", "malformed"},
      {"G1 X10" + std::string(5000, ' ') + "Y10", "longer than any firmware"},
      {"G1 " + std::string(1U << 21, 'x'), "megabyte"},
      {"G99999999999", "malformed number"},
  };
  for (const auto& c : cases) {
    const auto report = bench.moves("G1 X20\n" + c.line + "\nG1 X30 Y30\n");
    CAPTURE(c.line.substr(0, 80));
    REQUIRE(report.damaged_count == 1);
    CHECK(report.violation_count == 1);
    CHECK(report.findings[0].line == 8);
    CHECK_THAT(report.findings[0].problem, Catch::Contains(c.reason));
    CHECK(report.lines == 9);
  }
}

TEST_CASE("audit: sound lines in unusual dress are read", "[audit]") {
  Bench bench;
  bench.machine.firmware = Firmware::reprapfirmware;  // obeys several commands on one line, and words alone
  const char* const dressed[] = {
      "N12 G1 X120 Y10*40",
      "g1x120y10",
      "  G1\tX120  Y10 ; a comment",
      "G1 X 120 Y 10",
      "G1 X+120. Y10.0",
      "G01 X120 Y10",
      "G1 (aside) X120 (X300) Y10",
      "X120 Y10",
      "G90 G1 X120 Y10",
      "G1 X00000000000000000000120 Y10.000000000000000000000",
      "G1 X120 Y10\r",
      "G1 X120\rG1 Y10",
      "G1 F3000 S0 X120 Y10",
  };
  for (const auto* line : dressed) {
    CAPTURE(line);
    const auto inside = bench.moves(fmt::format("{}\nG91\nG1 X80 Y-10\n", line));
    CHECK(inside.clean());
    CHECK(inside.unaudited_moves == 0);
    CHECK(bench.moves(fmt::format("{}\nG91\nG1 X80.1\n", line)).violation_count == 1);
    CHECK(bench.moves(fmt::format("{}\nG91\nG1 Y-10.1\n", line)).violation_count == 1);
  }
}

TEST_CASE("audit: the last line counts although no line feed ends it, and so do lines behind a byte-order mark",
          "[audit]") {
  const Bench bench;
  CHECK(bench.moves("G1 X201").violation_count == 1);
  CHECK(bench("\xEF\xBB\xBFG28\r\nG1 X201\r\n").findings.at(0).line == 2);
  CHECK(bench("").empty());
  CHECK(bench("").verdict == Verdict::unaudited);
  CHECK(summary(bench("; only a comment\n")) == "nothing to audit: did the upload break off?");
  CHECK(bench(std::string(3U << 20, ' ')).violation_count == 1);
  CHECK(bench(";" + std::string(3U << 20, ' ')).violation_count == 0);
}

TEST_CASE("audit: numbers are read to the last digit", "[audit]") {
  for (const auto& [text, expected] :
       std::vector<std::pair<std::string, double>>{{"0", 0},
                                                   {"-0.001", -0.001},
                                                   {"+12.5", 12.5},
                                                   {".5", 0.5},
                                                   {"5.", 5},
                                                   {"123456.789012", 123456.789012},
                                                   {"0.1", 0.1},
                                                   {"199.99999999999999999999", 200},
                                                   {"000000000000000000000000123.25", 123.25}}) {
    double v = 0;
    const std::string line = text + "\n";
    const char* const end = scan::number(line.data(), v);
    CAPTURE(text);
    REQUIRE(end == line.data() + text.size());
    CHECK(v == expected);
  }
  double v = 0;
  for (const auto* bad : {"\n", "-\n", ".\n", "+.\n", "x\n"}) CHECK(scan::number(bad, v) == nullptr);
}

}  // namespace weft::audit
