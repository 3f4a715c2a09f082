// SPDX-License-Identifier: GPL-3.0-or-later
// Klipper's commands, read to the letter: one line must not blind the audit.
#include "audit/klipper.h"

#include "audit/audit_fixture.h"

#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace weft::audit {

TEST_CASE("audit: one line that a firmware reads otherwise than the audit does not blind it", "[audit][klipper]") {
  const Bench bench;
  const std::string digits(400, '9');
  const std::string lines[] = {
      "SET_GCODE_OFFSET X=nan",
      "SET_GCODE_OFFSET X=-inf",
      "SET_GCODE_OFFSET X=1e300",
      "SET_GCODE_OFFSET X_ADJUST=nan Y=0",
      "SET_GCODE_OFFSET X=+300",
      "SET_GCODE_OFFSET x=300",
      "set_gcode_offset x_adjust=300",
      "SET_GCODE_OFFSET X=3_0_0",
      "SET_GCODE_OFFSET X=' 300 '",
      "SET_GCODE_OFFSET X=3\"0\"0",
      "SET_GCODE_OFFSET X=\\300",
      "SET_GCODE_OFFSET X=0 X=300",
      "SET_GCODE_OFFSET A=';' X=300",
      "SET_GCODE_OFFSET X=.3e3 ; X=0",
      "SET_GCODE_OFFSET\tX=300 # X=0",
      "N7 SET_GCODE_OFFSET X=300*18",
      "SET_GCODE_OFFSET X=three hundred",
      "SET_GCODE_OFFSET X=",
      "SET_GCODE_OFFSET X='300",
      "SET_GCODE_OFFSET X_ADJU\xc5\xbfT=300",
      "\xc5\xbf"
      "ET_GCODE_OFFSET X=300",
      "SET_GCODE_OFF\xc5\xbf"
      "ET X=300",
      "SET_GCODE_OFFSET X=300\nG28",  // homing keeps it
      "SET_GCODE_OFFSET X=300\nG92 X0\nG28 X",
      "SET_GCODE_OFFSET X=300\nSAVE_GCODE_STATE\nSET_GCODE_OFFSET X=0\nRESTORE_GCODE_STATE\nG28",
      "SET_GCODE_OFFSET X=300\nSAVE_GCODE_STATE NAME=a\nSET_GCODE_OFFSET X=0\nrestore_gcode_state name=a",
      "SAVE_GCODE_STATE\nG91\nSAVE_GCODE_STATE NAME=b\nG90\nRESTORE_GCODE_STATE NAME=b\nG1 X50\nG1 X60",
      "SET_GCODE_OFFSET X=300 MOVE=1",
      "SET_GCODE_OFFSET X=0 MOVE=yes",
      "G92 X-" + digits,
      "G91\nG1 X" + digits + "\nG1 X-" + digits + "\nG90",
      "G1 X" + digits + " Y10",
      "G3 X110 Y110 I" + digits + " J0",
      "G92 X-150000",
      "G 92 X-300",
  };
  for (const auto& line : lines) {
    const auto report = bench.moves(line + "\nG1 X20 Y20\nG1 X30 Y20\nG1 X30 Y30\n");
    CAPTURE(line.substr(0, 80));
    CHECK_FALSE(report.clean());
  }
}

TEST_CASE("audit: Klipper's offset outlives homing, and zero is zero", "[audit][klipper]") {
  const Bench bench;
  CHECK(bench.moves("SET_GCODE_OFFSET X=10\nG28\nG1 X190 Y10\n").clean());
  CHECK(bench.moves("SET_GCODE_OFFSET X=10\nG28\nG1 X191 Y10\n").findings.at(0).outside == 1000);
  CHECK(bench.moves("SET_GCODE_OFFSET X=10\nG28\nSET_GCODE_OFFSET X=0\nG1 X199 Y10\n").clean());
  CHECK(
      bench.moves("SET_GCODE_OFFSET X=-10\nSAVE_GCODE_STATE\nSET_GCODE_OFFSET X=0\nRESTORE_GCODE_STATE\nG28\nG1 X210\n")
          .clean());
  // A whole offset goes before a step, as in Klipper.
  CHECK(bench.moves("SET_GCODE_OFFSET X=5 X_ADJUST=300\nG1 X190\n").clean());
}

TEST_CASE("audit: G92 without an axis sets all of them to zero in Klipper, whatever else stands there",
          "[audit][klipper]") {
  Bench bench;
  bench.machine.firmware = Firmware::klipper;
  for (const std::string line : {"G92", "G92 S1", "G92 F600", "N3 G92 A0"}) {
    CAPTURE(line);
    CHECK(bench.moves(line + "\nG1 X99 Y-99\n").clean());
    CHECK(bench.moves(line + "\nG1 X101\n").findings.at(0).outside == 1000);
  }
  CHECK(bench.moves("G92 E0\nG1 X199 Y10\n").clean());
  bench.machine.firmware = Firmware::marlin2;
  CHECK(bench.moves("G92 S1\nG1 X199 Y10\n").clean());
  CHECK_FALSE(bench.moves("G92\nG1 X99\n").clean());
}

TEST_CASE("audit: a command that moves the nozzle besides is judged as a move", "[audit][klipper]") {
  const Bench bench;
  const auto offset = bench.moves("SET_GCODE_OFFSET Y=101 MOVE=1\n");
  REQUIRE(offset.violation_count == 1);
  CHECK(offset.findings[0].side == Side::plus_y);
  CHECK(offset.findings[0].outside == 1000);
  CHECK(bench.moves("SET_GCODE_OFFSET Z=-1 MOVE=1\n").findings.at(0).side == Side::minus_z);
  CHECK(bench.moves("SET_GCODE_OFFSET Y=101 MOVE=0\n").clean());
  CHECK(bench.moves("SAVE_GCODE_STATE NAME=s\nG1 X20\nRESTORE_GCODE_STATE NAME=s MOVE=1\nG91\nG1 X99\n").clean());
  CHECK(bench.moves("SAVE_GCODE_STATE NAME=s\nG1 X20\nRESTORE_GCODE_STATE NAME=s MOVE=1\nG91\nG1 X101\n")
            .findings.at(0)
            .line == 11);
  CHECK(bench.moves("SAVE_GCODE_STATE NAME=s\nG1 X20\nRESTORE_GCODE_STATE NAME=s\nG1 X30\n").checked_moves == 3);
}

TEST_CASE("audit: what Klipper does not know as it is written is no command", "[audit][klipper]") {
  Bench bench;
  bench.machine.firmware = Firmware::klipper;
  for (const std::string line :
       {"G91 (X1)", "G91 5", "G090", "G092 X5", "G028", "M083 -", "T01", "G X5 Y5", "N G1 X5", "M", "G"}) {
    CAPTURE(line);
    CHECK_FALSE(bench.moves(line + "\nG1 X20 Y20\n").clean());
  }
  for (const std::string line :
       {"G91\nG90", "G91 ; (X1)\nG90", "N5 G90*21", "M117 (5%) 100", "M104 (hot) S200", "G28 X (left)", "M83\t"}) {
    CAPTURE(line);
    CHECK(bench.moves(line + "\nG1 X20 Y20\n").clean());
  }
}

TEST_CASE("audit: a step from where a macro left the nozzle is not audited", "[audit][klipper]") {
  const Bench bench;
  for (const std::string step :
       {"SET_GCODE_OFFSET Z=-1.5 MOVE=1", "SET_GCODE_OFFSET X_ADJUST=5 MOVE=1", "M290 Z-1.5", "M290 Y0.1"}) {
    CAPTURE(step);
    CHECK(bench("G28\nPRINT_START\n" + step + "\nG1 X50 Y50 Z5\n").unaudited_moves >= 1);
    CHECK(bench("G28\nPRINT_START\nG1 X50 Y50 Z5\n" + step + "\nG1 X60\n").clean());
  }
  CHECK(bench("G28\nPRINT_START\nSET_GCODE_OFFSET Z=-5\nG1 X50 Y50 Z5\n").clean());
  CHECK(bench("G28\nPRINT_START\nSET_GCODE_OFFSET Z=-0.05 MOVE=1\nG1 X50 Y50 Z5\n").clean());  // a trim
  CHECK(bench("G28\nPRINT_START\nM290 Z0.02\nG1 X50 Y50 Z5\n").clean());
}

TEST_CASE("audit: extended arguments are split as Klipper's host splits them", "[audit][klipper]") {
  using klipper::arguments_of;
  const auto value = [](std::string_view text, std::string_view key) -> std::string {
    const auto all = arguments_of(text);
    if (!all) return "refused";
    const auto at = all->find(key);
    return at == all->end() ? "absent" : at->second;
  };
  CHECK(value(" X=1 y=2", "Y") == "2");
  CHECK(value(" X=1 X=2", "X") == "2");
  CHECK(value(" MSG='a b;c' X=3", "X") == "3");
  CHECK(value(" MSG=\"a \\\" b\" X=3", "MSG") == "a \" b");
  CHECK(value(" MSG=\"a \\n b\"", "MSG") == "a \\n b");
  CHECK(value(" MSG='a \\' X=3", "MSG") == "a \\");
  CHECK(value(" X=1;Y=2", "X") == "1");
  CHECK(value(" X=1;Y=2", "Y") == "absent");
  CHECK(value(" X=1#2", "X") == "1");
  CHECK(value(" 'X=1 2'", "X") == "1 2");
  CHECK(value(" X==1", "X") == "=1");
  CHECK(value(" X=\r", "X").empty());
  CHECK(value("", "X") == "absent");
  for (const auto* bad : {" X", " X=1 ''", " X='1", " X=1\\", " X=\"1\\", " \xc3\xa4=1"}) {
    CAPTURE(bad);
    CHECK(value(bad, "X") == "refused");
  }
}

TEST_CASE("audit: numbers of extended commands are what Python reads", "[audit][klipper]") {
  using klipper::integer_of;
  using klipper::number_of;
  for (const auto& [text, v] : {std::pair{"+300", 300.0}, {" 3e2\t", 300.0}, {"-.5", -0.5}, {"5.", 5.0}, {"1_0", 10.0}})
    CHECK(number_of(text) == v);
  for (const auto* text : {"inf", "-Infinity", "1e400"}) CHECK(std::isinf(number_of(text).value()));
  CHECK(std::isnan(number_of("NaN").value()));
  for (const auto* bad :
       {"", "+", "1,5", "0x10", "1 0", "_1", "1_", "1__0", "1e", "+-1", "--1", "nan(1)", "\xef\xbc\x93"}) {
    CAPTURE(bad);
    CHECK_FALSE(number_of(bad).has_value());
  }
  CHECK(integer_of(" +1 ") == 1);
  CHECK(integer_of("-01") == -1);
  CHECK(integer_of("1_0") == 10);
  for (const auto* bad : {"", "1.0", "yes", "+-1", "99999999999"}) CHECK_FALSE(integer_of(bad).has_value());
}

}  // namespace weft::audit
