// SPDX-License-Identifier: GPL-3.0-or-later
// Prints of several tools, and what happens at heights, as users meet them.
#include "cli/program.h"

#include <algorithm>
#include <sstream>

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) out.push_back(line);
  return out;
}

std::size_t count_of(const std::string& text, const std::string& line) {
  const auto lines = lines_of(text);
  return static_cast<std::size_t>(std::count(lines.begin(), lines.end(), line));
}

/// Z of the last layer that began before the line.
std::string height_before(const std::string& gcode, const std::string& wanted) {
  std::string z;
  for (const auto& line : lines_of(gcode)) {
    if (line.starts_with(";Z:")) z = line.substr(3);
    if (line.starts_with(wanted)) return z;
  }
  return "never";
}

/// Everything but comments, which hold the settings.
std::string commands_of(const std::string& gcode) {
  std::string out;
  for (const auto& line : lines_of(gcode))
    if (!line.starts_with(";")) out += line + "\n";
  return out;
}

struct Boxes {
  Scratch scratch;
  Boxes() {
    scratch.write("a.stl", box_stl(10, 10, 2));
    scratch.write("b.stl", box_stl(10, 10, 2));
    scratch.write("two.ini", "nozzle_diameter = 0.4, 0.4\nmaterial_print_temperature = 210, 230\n");
  }
  std::string slice(std::vector<std::string> more, int status = 0) const {
    std::vector<std::string> words{"slice", "-o", "out.gcode", "-q"};
    words.insert(words.end(), more.begin(), more.end());
    const auto run = weft(words, scratch.path());
    INFO(run.err);
    REQUIRE(run.status == status);
    return status == 0 ? scratch.read("out.gcode") : run.err;
  }
};

}  // namespace

TEST_CASE("cli: a pause comes before the first layer that reaches above its height, and the print goes on from there") {
  const Boxes boxes;
  const auto gcode = boxes.slice({"a.stl", "--pause", "1=lay the nut in", "-s", "firmware=marlin2"});
  CHECK(count_of(gcode, "M0 lay the nut in") == 1);
  CHECK(height_before(gcode, "M0") == "1.2");
  // Drawn back before, pushed forward after.
  const auto lines = lines_of(gcode);
  const auto pause = std::find(lines.begin(), lines.end(), "M0 lay the nut in");
  const auto before = std::find_if(std::make_reverse_iterator(pause), lines.rend(),
                                   [](const std::string& line) { return line.starts_with("G1"); });
  CHECK_THAT(*before, Contains("E-"));
  const auto after = std::find_if(pause, lines.end(), [](const std::string& line) { return line.starts_with("G1"); });
  CHECK_THAT(*after, Contains("E") && !Contains("X"));
}

TEST_CASE("cli: each firmware has its own words for a colour change") {
  const Boxes boxes;
  for (const auto& [firmware, word] : {std::pair<std::string, std::string>{"marlin2", "M600"},
                                       {"reprapfirmware", "M600"},
                                       {"klipper", "PAUSE"},
                                       {"repetier", "@pause change the filament"}}) {
    INFO(firmware);
    const auto gcode = boxes.slice({"a.stl", "--color-change", "0.6", "-s", "firmware=" + firmware});
    CHECK(count_of(gcode, word) == 1);
    CHECK(height_before(gcode, word) == "0.8");
  }
  const auto own = boxes.slice({"a.stl", "--color-change", "0.6", "-s", "color_change_gcode=M117 swap at {layer_z}"});
  CHECK(count_of(own, "M117 swap at 0.8") == 1);
  CHECK(count_of(own, "M600") == 0);
}

TEST_CASE("cli: G-code at a height is written once, before the layer that reaches above it") {
  const Boxes boxes;
  const auto gcode = boxes.slice({"a.stl", "-s", "gcode_at_heights=1 = M117 halfway\\nM300"});
  CHECK(count_of(gcode, "M117 halfway") == 1);
  CHECK(count_of(gcode, "M300") == 1);
  CHECK(height_before(gcode, "M117") == "1.2");
}

TEST_CASE("cli: a pause above everything is told, and changes nothing else") {
  const Boxes boxes;
  const auto plain = boxes.slice({"a.stl"});
  const auto run = weft({"slice", "a.stl", "-o", "out.gcode", "--pause", "50"}, boxes.scratch.path());
  CHECK(run.status == 0);
  CHECK_THAT(run.err, Contains("pause_at_heights: nothing is printed above 50 mm"));
  CHECK(commands_of(boxes.scratch.read("out.gcode")) == commands_of(plain));
}

TEST_CASE("cli: two models on two tools change once a layer, each is printed by its own, and each tool is reported") {
  const Boxes boxes;
  const auto gcode = boxes.slice({"a.stl", "b.stl@T1", "-p", "two.ini", "--report", "out.json", "-s",
                                  "firmware=marlin2", "-s", "adhesion_type=none"});
  // Each layer begins with the tool that the one below ended with: 10 layers, 10 changes and the first tool.
  const auto t0 = count_of(gcode, "T0"), t1 = count_of(gcode, "T1");
  CHECK(t0 + t1 == 11);
  CHECK_THAT(gcode, Contains("M109 T1 S230"));
  const auto report = json::parse(boxes.scratch.read("out.json"));
  REQUIRE(report["tools"].size() == 2);
  const double first = report["tools"][0]["filament"]["mm3"], second = report["tools"][1]["filament"]["mm3"];
  CHECK(first > 100);
  CHECK(second == Approx(first).epsilon(0.03));
  CHECK(report["audit"]["verdict"] == "pass");
}

TEST_CASE("cli: everything on the first of two tools has the commands of one, but for the choice of it") {
  const Boxes boxes;
  const auto one = commands_of(boxes.slice({"a.stl", "b.stl", "-s", "firmware=marlin2"}));
  auto two = boxes.slice({"a.stl", "b.stl", "-s", "firmware=marlin2", "-s", "extruders_enabled_count=2"});
  CHECK(count_of(two, "T0") == 1);
  CHECK(count_of(two, "T1") == 0);
}

TEST_CASE("cli: filaments that share a nozzle are purged into a tower, and the audit passes it") {
  const Boxes boxes;
  const auto gcode =
      boxes.slice({"a.stl", "b.stl@T1", "-s", "tool_nozzles=0,0", "-s", "firmware=marlin2", "--report", "out.json"});
  const auto report = json::parse(boxes.scratch.read("out.json"));
  const double tower = report["features"]["wipe_tower"]["mm3"];
  CHECK(tower > 9 * 140);  // ten layers, a change in each, none before the first tool
  CHECK(report["audit"]["verdict"] == "pass");
  CHECK_THAT(gcode, Contains(";TYPE:Wipe tower"));
}

TEST_CASE("cli: a tower that is told to stand outside the bed is refused with how far, and nothing is written") {
  const Boxes boxes;
  const auto error = boxes.slice({"a.stl", "b.stl@T1", "-s", "tool_nozzles=0,0", "-s", "prime_tower_position_x=215",
                                  "-s", "prime_tower_position_y=100"},
                                 5);
  CHECK_THAT(error, Contains("prime_tower_position_x: the tower with its brim") && Contains("at +x"));
  CHECK_FALSE(boxes.scratch.has("out.gcode"));
}

TEST_CASE("cli: a tool that there is not is refused by name") {
  const Boxes boxes;
  CHECK_THAT(boxes.slice({"a.stl@T4", "-p", "two.ini"}, 3),
             Contains("there is no tool 4, the printer has T0 … T1") && Contains("extruders_enabled_count"));
  CHECK_THAT(boxes.slice({"a.stl", "-p", "two.ini", "-s", "infill_extruder_nr=2"}, 3),
             Contains("infill_extruder_nr: there is no tool 2"));
}

TEST_CASE("cli: lists of settings are as long as there are tools") {
  const Boxes boxes;
  boxes.scratch.write("wrong.ini", "extruders_enabled_count = 4\nnozzle_diameter = 0.4, 0.4, 0.6\n");
  CHECK_THAT(boxes.slice({"a.stl", "-p", "wrong.ini"}, 3),
             Contains("wrong.ini:2: nozzle_diameter: 3 values for 4 tools; give 1 or 4"));
  CHECK_THAT(boxes.slice({"a.stl", "-s", "retraction_amount=0,8"}, 3), Contains("2 values for 1 tool"));
}

TEST_CASE("cli: a section of a profile, an option and a key with a number are the same tool") {
  const Boxes boxes;
  boxes.scratch.write("petg.ini", "material_type = PETG\nmaterial_print_temperature = 240\n");
  boxes.scratch.write("section.ini", "[tool 1]\nmaterial_type = PETG\nmaterial_print_temperature = 240\n");
  const auto a = boxes.slice({"a.stl", "b.stl@T1", "-p", "section.ini"});
  const auto b = boxes.slice({"a.stl", "b.stl@T1", "--tool", "1=petg.ini"});
  const auto c = boxes.slice(
      {"a.stl", "b.stl@T1", "-s", "tool.1.material_type=PETG", "-s", "tool.1.material_print_temperature=240"});
  CHECK(a == b);
  CHECK(a == c);
  CHECK_THAT(a, Contains("M109 T1 S240"));
}

TEST_CASE("cli: features choose their tools") {
  const Boxes boxes;
  const auto gcode = boxes.slice({"a.stl", "-s", "extruders_enabled_count=2", "-s", "infill_extruder_nr=1", "-s",
                                  "firmware=marlin2", "--report", "out.json"});
  const auto report = json::parse(boxes.scratch.read("out.json"));
  REQUIRE(report["tools"].size() == 2);
  CHECK(report["tools"][1]["filament"]["mm3"].get<double>() ==
        Approx(report["features"]["infill"]["mm3"].get<double>()).epsilon(0.01));
}

TEST_CASE(
    "cli: parts of one object keep their places, each has its tool, and where they overlap the later one has it") {
  const Boxes boxes;
  boxes.scratch.write("inner.stl", box_stl(4, 4, 2));
  boxes.slice({"a.stl+inner.stl@T1", "-s", "extruders_enabled_count=2", "--report", "out.json", "-s",
               "infill_sparse_density=100", "-s", "adhesion_type=none"});
  const auto report = json::parse(boxes.scratch.read("out.json"));
  REQUIRE(report["tools"].size() == 2);
  const double outer = report["tools"][0]["filament"]["mm3"], inner = report["tools"][1]["filament"]["mm3"];
  CHECK(inner == Approx(32).epsilon(0.15));
  CHECK(outer == Approx(200 - 32).epsilon(0.15));
}
