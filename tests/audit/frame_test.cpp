// SPDX-License-Identifier: GPL-3.0-or-later
// What moves the frame of reference is followed, or the verdict says from which line on moves are not audited.
#include "audit/audit_fixture.h"

#include <algorithm>
#include <random>

#include <fmt/format.h>

namespace weft::audit {
namespace {

constexpr std::string_view square = "G1 X20 Y20 F9000\nG1 X180 Y20\nG1 X180 Y180\nG1 X20 Y180\nG1 X20 Y20\n";

std::string plain_print(std::string_view start) {
  return fmt::format("G28\nG90\nM83\n{}\nG1 Z0.2 F600\n;LAYER_CHANGE\n;HEIGHT:0.2\n;TYPE:Perimeter\n;WIDTH:0.4\n{}",
                     start, square);
}

}  // namespace

TEST_CASE("audit: what shifts, turns or scales the coordinates is never a pass", "[audit][frame]") {
  Bench bench;
  for (const auto* start : {"G92 X-500",
                            "G92 X-500 Y0",
                            "M206 X500",
                            "M206 Y-40",
                            "M428",
                            "G10 L2 P1 X500",
                            "G10 L20 P1 X-500",
                            "G54\nG10 L2 P1 X500",
                            "G68 R45",
                            "G68 X100 Y100 R30",
                            "G51 X2 Y2",
                            "G52 X500",
                            "G55",
                            "G56",
                            "G57",
                            "G58",
                            "G59",
                            "G59.3",
                            "G16",
                            "G7",
                            "G43 H1\nG1 Z5",
                            "M92 X160",
                            "M579 Y2",
                            "M665 L500",
                            "M666 X9",
                            "M669 K1",
                            "M852 I0.1",
                            "M556 S100 X5",
                            "M808 L5",
                            "M28 other.gcode",
                            "SET_GCODE_OFFSET X=300",
                            "SET_GCODE_OFFSET Y_ADJUST=-40",
                            "SET_SKEW XY=100,90,80",
                            "SET_KINEMATIC_POSITION X=10",
                            "FORCE_MOVE STEPPER=stepper_x DISTANCE=50 VELOCITY=10",
                            "RESTORE_GCODE_STATE NAME=of_a_macro",
                            "M290 X50",
                            "M290 R0 Z5",
                            "M605 S2",
                            "G91.1",
                            "G90.1",
                            "G20",
                            "G91",
                            "SDCARD_LOOP_BEGIN COUNT=0",
                            "G90 G92 X-300",
                            "X300 Y20",
                            "G 92 X-300",
                            "M218 T0 X50",
                            "M502",
                            "M585 X100 P1",
                            "M810 G92 X500|G1 X5",
                            "G10 X50",
                            "SET_TMC_FIELD STEPPER=stepper_x FIELD=shaft VALUE=1",
                            "SET_TMC_FIELD STEPPER=stepper_x FIELD=MRES VALUE=0",
                            "TUNING_TOWER COMMAND=SET_GCODE_OFFSET PARAMETER=X START=500 FACTOR=0",
                            "TUNING_TOWER COMMAND=\"G92 X500\" PARAMETER=E START=0 FACTOR=0"}) {
    CAPTURE(start);
    CHECK_FALSE(bench(plain_print(start)).clean());
  }
  // What RepRapFirmware alone obeys: restore points, ends at switches, motors, where homing leads.
  for (const std::string start :
       {"G1 X20 Y20\nG60 S0\nG1 R0 X150", "G1 H1 X20\nG91\nG1 X5\nG90", "M569 P0 S0", "M208 X500 S0\nG28"}) {
    CAPTURE(start);
    bench.machine.firmware = Firmware::marlin2;
    CHECK(bench(plain_print(start)).clean());
    bench.machine.firmware = Firmware::reprapfirmware;
    CHECK_FALSE(bench(plain_print(start)).clean());
  }
  bench.machine.firmware = MachineSettings{}.firmware;
  // Before homing nothing is known that G92 could refer to; homing takes it back.
  CHECK_FALSE(bench("G92 X500\n;LAYER_CHANGE\n" + std::string(square)).clean());
  CHECK(bench("G92 X500\n" + plain_print("M117 ready")).clean());
  // What comes back is known again.
  for (const auto* start : {"G68 R45\nG69", "G51 X2\nG50", "G43 H1\nG49", "G16\nG15", "G7\nG8", "G54", "M92 E93",
                            "G91.1\nG90", "M206", "SET_SKEW CLEAR=1", "M218 T1 X5", "G92 E0", "M605 S1", "M290 Z0.02",
                            "G92.1", "SET_TMC_FIELD STEPPER=stepper_x FIELD=tpfd VALUE=3",
                            "TUNING_TOWER COMMAND=SET_PRESSURE_ADVANCE FACTOR=.005", "M569 P0 S1"}) {
    CAPTURE(start);
    CHECK(bench(plain_print(start)).clean());
  }
}

TEST_CASE("audit: an unaudited verdict says from which line, why, how many moves, and what to do", "[audit][frame]") {
  const Bench bench;
  const auto report = bench(plain_print("M206 X500\nG68 R45"));
  CHECK(report.verdict == Verdict::unaudited);
  CHECK(report.unaudited_moves == 5);
  REQUIRE_FALSE(report.unaudited.empty());
  CHECK(report.unaudited[0].cause.command == "M206");
  CHECK(report.unaudited[0].cause.line == 4);
  CHECK_THAT(summary(report), Catch::Contains("5 moves not audited (M206 on line 4: it moves the origin"));
  CHECK_THAT(remedy(report), Catch::Contains("M206"));
  CHECK_THROWS_AS(check(bench.machine, bench.material, bench.settings, plain_print("M428"), Mode::reject), Rejected);
  const auto annotated = check(bench.machine, bench.material, bench.settings, plain_print("M428"), Mode::annotate);
  CHECK(annotated.report().verdict == Verdict::annotated);
  CHECK_THAT(std::string(annotated.gcode()), Catch::Contains("; weft_audit = annotated: 6 moves not audited\n"));
  CHECK_THAT(std::string(annotated.gcode()), Catch::Contains("; WEFT-AUDIT not audited: M428 on line 4"));
}

TEST_CASE("audit: what only the printer knows is named in the verdict", "[audit][frame]") {
  const Bench bench;
  for (const auto* command : {"T1",
                              "M0",
                              "M1",
                              "M25",
                              "M23 other.gcode",
                              "M24",
                              "M32 other.gcode",
                              "M98 P\"x.g\"",
                              "M600",
                              "M125",
                              "G27",
                              "G29",
                              "G12",
                              "UPDATE_DELAYED_GCODE ID=x DURATION=1",
                              "PRINT_START",
                              "M1234",
                              "ACTIVATE_EXTRUDER EXTRUDER=other",
                              "SKEW_PROFILE LOAD=a",
                              "@pause",
                              "M501",
                              "M701"}) {
    CAPTURE(command);
    const auto report = bench(plain_print(command));
    CHECK(report.clean());
    REQUIRE(report.opaque.size() == 1);
    CHECK(report.opaque[0].name == std::string(command).substr(0, std::string_view(command).find(' ')));
    CHECK_THAT(header_value(report), Catch::Contains("; opaque: " + report.opaque[0].name));
  }
  for (const auto* command : {"T0", "M104 S200", "M862.3 P \"MK3S\"", "ACTIVATE_EXTRUDER EXTRUDER=extruder",
                              "UPDATE_DELAYED_GCODE ID=x DURATION=0", "M73 P0 R5", "M486 S-1", "M117 G1 X500"})
    CHECK(bench(plain_print(command)).opaque.empty());
}

TEST_CASE("audit: the lift of firmware retraction is part of the height", "[audit][frame]") {
  const Bench bench;
  CHECK(bench.moves("M207 S1 Z5\nG1 Z195\nG10\nG1 X50\nG11\n").clean());
  const auto high = bench.moves("M207 S1 Z5\nG1 Z196\nG10\nG1 X50\nG11\nG1 X60\n");
  REQUIRE(high.violation_count == 2);
  CHECK(high.findings[0].line == 9);
  CHECK(high.findings[0].side == Side::plus_z);
}

TEST_CASE("audit: a thousand prints whose frame is moved in one place are never passed", "[audit][frame][sabotage]") {
  std::mt19937 random(20'260'204);
  const auto pick = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random); };
  const auto length = [&] { return 25 + 500 * std::uniform_real_distribution<double>(0, 1)(random); };
  int passed = 0, found = 0, unaudited = 0;
  for (int i = 0; i < 1000; ++i) {
    Bench bench;
    bench.machine.firmware =
        std::array{Firmware::marlin2, Firmware::klipper, Firmware::reprapfirmware, Firmware::smoothie}[pick(4)];
    const bool klipper = bench.machine.firmware == Firmware::klipper;
    const double by = length() * (pick(2) ? 1 : -1);
    const double far = by + (by > 0 ? 200 : -200);  // from wherever the nozzle is
    const char axis = pick(2) ? 'X' : 'Y';
    const std::string ways[] = {
        fmt::format("G92 {}{:.3f}", axis, far),
        fmt::format("SET_GCODE_OFFSET {}={:.3f}", axis, by),
        fmt::format("set_gcode_offset {}_adjust=+{:.3f}", axis, std::abs(by)),
        fmt::format("SET_GCODE_OFFSET {}='{:.3f}' MOVE={}", axis, by, pick(2)),
        fmt::format("SET_GCODE_OFFSET {}={:.3f}\nG28", axis, by),
        fmt::format(
            "SET_GCODE_OFFSET {0}={1:.3f}\nSAVE_GCODE_STATE NAME=s\nSET_GCODE_OFFSET {0}=0\nRESTORE_GCODE_STATE NAME=s",
            axis, by),
        fmt::format("G10 L2 P1 {}{:.3f}", axis, by),
        fmt::format("G10 L20 P1 {}{:.3f}", axis, far),
        fmt::format("G10 L2 P{0} {1}{2:.3f}\nG{3}", 2, axis, by, 55),
        fmt::format("G{}", 55 + pick(5)),
        fmt::format("M206 {}{:.3f}", axis, by),
        fmt::format("M290 {}{:.3f}", axis, by),
        fmt::format("G68 R{:.1f}", 5 + 0.3 * length()),
        fmt::format("G51 {}2", axis),
        fmt::format("G52 {}{:.3f}", axis, by),
        fmt::format("M92 {}{:.1f}", axis, length()),
        fmt::format("M665 L{:.1f}", length()),
        fmt::format("SET_KINEMATIC_POSITION {}={:.3f}", axis, by),
        "M428",
        "G20",
        "G91",
        fmt::format("SAVE_GCODE_STATE\nG91\nSAVE_GCODE_STATE NAME=r\nG90\nRESTORE_GCODE_STATE NAME=r"),
        "RESTORE_GCODE_STATE NAME=unknown",
        fmt::format("SET_GCODE_OFFSET {}=nan", axis),
        fmt::format("G92 {}{}", axis, std::string(400, '7')),
    };
    const std::string sabotage = ways[pick(std::size(ways))];
    // Somewhere in a print of four layers, which reaches within 20 mm of every edge.
    std::string print = "G28\nG90\nM83\n";
    const std::size_t layer = pick(4), line = pick(4);
    for (std::size_t l = 0; l < 4; ++l) {
      print += fmt::format(";LAYER_CHANGE\n;HEIGHT:0.2\nG1 Z{:.1f}\n;TYPE:Perimeter\n;WIDTH:0.4\n",
                           0.2 * static_cast<double>(l + 1));
      std::string_view rest = square;
      for (std::size_t k = 0; !rest.empty(); ++k) {
        if (l == layer && k == line) print += sabotage + "\n";
        const auto end = rest.find('\n') + 1;
        print += rest.substr(0, end);
        rest.remove_prefix(end);
      }
    }
    print += square;
    const auto report = bench(print);
    found += report.violation_count > 0;
    unaudited += report.verdict == Verdict::unaudited;
    // A workspace command is another firmware's retraction; that it is not audited there is right, too.
    if (report.clean()) {
      ++passed;
      UNSCOPED_INFO((klipper ? "klipper " : "") << sabotage.substr(0, 80));
    }
  }
  CHECK(passed == 0);
  CHECK(found > 300);
  CHECK(unaudited > 200);
}

}  // namespace weft::audit
