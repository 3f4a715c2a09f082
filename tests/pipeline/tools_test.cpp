// SPDX-License-Identifier: GPL-3.0-or-later
// A plan of two tools made by hand, on its way through motion, codec, writer and audit.
#include "audit/audit.h"
#include "audit/reader.h"
#include "gcode/writer.h"
#include "motion/motion.h"
#include "pipeline/codec.h"
#include "settings/first_layer.h"

#include <array>
#include <sstream>
#include <variant>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::literals;
using Catch::Matchers::Contains;

namespace {

Extrude line(Point from, Point to, ToolId tool) {
  return {.path = {{from, 400, 1.F}, {to, 400, 1.F}}, .role = Role::outer_wall, .tool = tool, .height = 200};
}

/// Two layers; each tool draws a line of 20 mm in the first, whose settings are scope 1, T1 one of 10 mm in the second.
PrintPlan two_tools() {
  PrintPlan plan;
  LayerPlan first{.z = 200, .height = 200};
  first.steps = {SetTemperature{SetTemperature::Heater::nozzle, 1, 190, false},
                 ToolChange{0},
                 Travel{{{20_mm, 20_mm, 200}}},
                 line({20_mm, 20_mm}, {40_mm, 20_mm}, 0),
                 Retract{},
                 SetTemperature{SetTemperature::Heater::nozzle, 1, 215, true},
                 ToolChange{1},
                 Travel{{{20_mm, 40_mm, 200}}},
                 Prime{},
                 line({20_mm, 40_mm}, {40_mm, 40_mm}, 1)};
  LayerPlan second{.z = 400, .height = 200, .time = {.index = 1, .number = 1}};
  second.steps = {Retract{}, Pause{"lay the nut in"}, Travel{{{20_mm, 40_mm, 400}}}, Prime{},
                  line({20_mm, 40_mm}, {30_mm, 40_mm}, 1)};
  first.scope = 1;
  for (auto& step : first.steps)
    if (auto* bead = std::get_if<Extrude>(&step)) bead->scope = 1;
  plan.layers = {first, second};
  return plan;
}

Settings settings_for(Firmware firmware) {
  Settings s;
  s.machine.firmware = firmware;
  s.machine.machine_width = s.machine.machine_depth = s.machine.machine_height = 200_mm;
  s.machine.home_position = Ring{{0, 0}};
  s.gcode.machine_start_gcode = "G28";
  s.gcode.machine_end_gcode = "M84";
  s.cooling.cool_min_layer_time = 0;
  return s;
}

/// As the pipeline does it: each layer planned, packed, digested, unpacked, written.
struct Printed {
  Settings settings;
  PrintPlan plan;
  Statistics statistics;
  std::string text;

  explicit Printed(Settings of) : settings(std::move(of)) {
    const std::array rules{motion::rules_of(settings), motion::rules_of(on_first_layer(settings), &settings)};
    auto planned = motion::plan(rules, two_tools());
    statistics = planned.statistics;
    std::vector<gcode::LayerDigest> digests;
    for (const auto& layer : planned.plan.layers) {
      digests.push_back(gcode::digest_of(settings, layer));
      pipeline::decode(pipeline::encode(layer), plan.layers.emplace_back());
    }
    text = gcode::write({settings, plan, statistics, "two", {}, {}, std::move(digests)});
  }
  audit::Passed audited() const {
    return audit::check(settings.machine, settings.material, settings.audit, text, audit::Mode::reject);
  }
};

/// Filament that each tool lays down, as the audit's reader sees it, mm.
std::vector<double> filament_by_tool(const std::string& text) {
  audit::Reader reader({.home = audit::Vec{0, 0}});
  std::vector<double> out(3);
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    line += '\n';
    reader.line(line.data(), line.data() + line.size() - 1);
    for (const auto& motion : reader.motions()) out.at(static_cast<std::size_t>(motion.tool)) += motion.e_mm;
  }
  return out;
}

}  // namespace

TEST_CASE("tools: a plan of two tools is written, passes the audit, and is read back as it was planned") {
  for (const auto firmware : {Firmware::marlin, Firmware::marlin2, Firmware::klipper, Firmware::reprapfirmware,
                              Firmware::repetier, Firmware::smoothie})
    for (const bool relative : {true, false}) {
      auto settings = settings_for(firmware);
      settings.gcode.relative_extrusion = relative;
      const Printed printed(settings);
      INFO(printed.text);
      const auto passed = printed.audited();
      CHECK(passed.report().clean());
      REQUIRE(printed.statistics.tools.size() == 2);
      const auto read = filament_by_tool(printed.text);
      CHECK(read[0] == Approx(printed.statistics.tools[0].filament_mm).margin(1e-4));
      CHECK(read[1] == Approx(printed.statistics.tools[1].filament_mm).margin(1e-4));
      CHECK(read[2] == 0);
    }
}

TEST_CASE("tools: each firmware is told in its own words, and the place is said again afterwards") {
  CHECK_THAT(Printed(settings_for(Firmware::marlin2)).text,
             Contains("M104 T1 S190\nT0\nG0 X20 Y20 F9000\nG0 Z.2") &&
                 Contains("M109 T1 S215\nT1\nG0 X20 Y40 F9000\nG0 Z.2") &&
                 Contains("M0 lay the nut in\nG0 X20 Y40 F9000\nG0 Z.4"));
  CHECK_THAT(Printed(settings_for(Firmware::klipper)).text,
             Contains("M104 T1 S190\nACTIVATE_EXTRUDER EXTRUDER=extruder\n") &&
                 Contains("M109 T1 S215\nACTIVATE_EXTRUDER EXTRUDER=extruder1\nG0 X20 Y40 F9000\nG0 Z.2") &&
                 Contains("M117 lay the nut in\nPAUSE\nG0 X20 Y40 F9000\nG0 Z.4"));
  CHECK_THAT(Printed(settings_for(Firmware::reprapfirmware)).text, Contains("G10 P1 S190 R190\nM568 P1 A1\n") &&
                                                                       Contains("G10 P1 S215 R215\nM116 P1\nT1\n") &&
                                                                       Contains("M226\nG0 X20 Y40 F9000\nG0 Z.4"));
  CHECK_THAT(Printed(settings_for(Firmware::repetier)).text,
             Contains("@pause lay the nut in\nG0 X20 Y40 F9000\nG0 Z.4"));
}

TEST_CASE("tools: a tool keeps what was drawn back of it, and one that comes new is not pushed forward") {
  auto settings = settings_for(Firmware::marlin2);
  settings.gcode.relative_extrusion = true;
  const auto text = Printed(settings).text;
  // T0 is drawn back when it leaves; the Prime of T1 says nothing; T1 is drawn back for the pause, and pushed forward.
  CHECK_THAT(text, Contains("G1 E-1 F2400\nM109 T1 S215\nT1\nG0 X20 Y40 F9000\nG0 Z.2 F600\nG1 X40"));
  CHECK_THAT(text,
             Contains("G1 E-1 F2400\n;PAUSE_PRINT\nM0 lay the nut in\nG0 X20 Y40 F9000\nG0 Z.4 F600\nG1 E1 F2400\n"));
}

TEST_CASE("tools: with absolute E each tool counts from zero") {
  auto settings = settings_for(Firmware::marlin2);
  settings.gcode.relative_extrusion = false;
  CHECK_THAT(Printed(settings).text, Contains("T1\nG92 E0\nG0 X20 Y40 F9000\nG0 Z.2"));
}

TEST_CASE("tools: tool_change_gcode knows from which tool to which, and may choose the tool itself") {
  auto settings = settings_for(Firmware::marlin2);
  settings.gcode.tool_change_gcode = "; {previous_extruder} to {next_extruder} at {toolchange_z}";
  CHECK_THAT(Printed(settings).text, Contains("; 0 to 0 at 0.2\nT0\n") && Contains("; 0 to 1 at 0.2\nT1\n"));
  settings.gcode.tool_change_gcode = "; {current_extruder}";
  CHECK_THAT(Printed(settings).text, Contains("; 0\nT1\n"));  // as in PrusaSlicer: until it is changed
  settings.gcode.tool_change_gcode = "G4 P100\nT{next_extruder}";
  const auto text = Printed(settings).text;
  CHECK_THAT(text, Contains("G4 P100\nT1\nG0 X20"));
  CHECK_THAT(text, !Contains("T1\nT1"));
}

TEST_CASE("tools: what each of them takes stands in the file and in the statistics") {
  const Printed printed(settings_for(Firmware::marlin2));
  const auto& tools = printed.statistics.tools;
  CHECK(tools[0].changes == 1);
  CHECK(tools[1].changes == 1);
  CHECK(tools[1].filament_mm == Approx(1.5 * tools[0].filament_mm));
  CHECK(tools[0].filament_mm + tools[1].filament_mm == Approx(printed.statistics.filament_mm));
  CHECK(tools[0].filament_g + tools[1].filament_g == Approx(printed.statistics.filament_g));
  CHECK_THAT(printed.text, Contains("; total toolchanges = 1\n; referenced_tools = 0,1\n"));
  CHECK_THAT(printed.text, Contains("; filament used [mm] = 0.67, 1.00\n"));
}

TEST_CASE("tools: where the nozzle is after a tool change or a pause is not taken for known") {
  const auto settings = settings_for(Firmware::marlin2);
  auto plan = two_tools();
  plan.layers[0].steps.resize(7);  // ends with the change to T1
  const auto digest = gcode::digest_of(settings, plan.layers[0]);
  gcode::MachineState state;
  state.at = Point3{1, 2, 3};
  gcode::advance(state, digest);
  CHECK_FALSE(state.at.has_value());
  CHECK(state.tool == 1);
  CHECK(state.drawn_back[0]);
  CHECK_FALSE(state.retracted());
}
