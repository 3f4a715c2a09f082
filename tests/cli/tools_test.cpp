// SPDX-License-Identifier: GPL-3.0-or-later
// Prints of several tools, and what happens at heights, as users meet them.
#include "cli/program.h"

#include <algorithm>
#include <cmath>
#include <iterator>
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

/// What moves filament alone around the first change to a tool, `14.4 F180`: neighbours one way at a speed are one.
std::vector<std::string> filament_moves(const std::string& gcode, const std::string& tool) {
  const auto lines = lines_of(gcode);
  const auto of_change = [&](const std::string& line) {
    return line == tool || line.starts_with("G0 ") || line.starts_with("G1 E");
  };
  const auto at = std::find(lines.begin(), lines.end(), tool);
  auto first = at, last = at;
  while (first != lines.begin() && of_change(*std::prev(first))) --first;
  while (last != lines.end() && of_change(*last)) ++last;
  std::vector<std::pair<double, std::string>> moves;  // mm, and the speed
  for (auto line = first; line != last; ++line) {
    if (*line == tool) moves.emplace_back(0, tool);
    if (!line->starts_with("G1 E")) continue;
    const double mm = std::stod(line->substr(4));
    const auto speed = line->substr(line->find('F'));
    if (!moves.empty() && moves.back().second == speed && mm * moves.back().first > 0)
      moves.back().first += mm;
    else
      moves.emplace_back(mm, speed);
  }
  std::vector<std::string> out;
  for (const auto& [mm, speed] : moves) {
    std::ostringstream text;
    if (speed != tool) text << std::round(mm * 1000) / 1000 << ' ';
    out.push_back(text.str() + speed);
  }
  return out;
}

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
  const auto error = boxes.slice({"a.stl", "b.stl@T1", "-s", "tool_nozzles=0,0", "-s", "prime_tower_position_x=225",
                                  "-s", "prime_tower_position_y=100"},
                                 5);
  CHECK_THAT(error, Contains("prime_tower_position_x: the tower with its brim") && Contains("at +x; auto, or at most"));
  CHECK_FALSE(boxes.scratch.has("out.gcode"));
  // What is told is enough at once, for the skirt around it too.
  const auto most = std::stod(error.substr(error.find("at most ") + 8));
  const auto put = [&](double x, int status) {
    boxes.slice({"a.stl", "b.stl@T1", "-s", "tool_nozzles=0,0", "-s", "prime_tower_position_x=" + std::to_string(x),
                 "-s", "prime_tower_position_y=100"},
                status);
  };
  put(most, 0);
  put(most + 0.5, 5);
  const auto half = boxes.slice({"a.stl", "b.stl@T1", "-s", "tool_nozzles=0,0", "-s", "prime_tower_position_y=5"}, 3);
  CHECK_THAT(half, Contains("prime_tower_position_y: prime_tower_position_x is auto; say where it stands along both"));
}

TEST_CASE("cli: the last place where the tower fits passes, and the next one is refused") {
  const Boxes boxes;
  const auto at = [&](const std::string& x, int status) {
    return boxes.slice(
        {"a.stl", "b.stl@T1", "-s", "tool_nozzles=0,0", "-s", "prime_tower_position_x=" + x, "-s", "adhesion_type=none",
         "-s", "prime_tower_position_y=20", "-s", "prime_tower_width=40", "-s", "machine_width=200"},
        status);
  };
  // 40 mm and a brim of four lines of 0.5 mm.
  CHECK_THAT(at("158", 0), Contains(";TYPE:Wipe tower"));
  CHECK_THAT(at("158.5", 5), Contains("leaves the print surface by 0.5 mm at +x; auto, or at most 158"));
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

TEST_CASE("cli: a nozzle that waits for long is cooled and heated again before its tool comes") {
  const Boxes boxes;
  boxes.scratch.write("high.stl", box_stl(40, 40, 2));
  // T1 prints the first two layers and the last one.
  const auto gcode = boxes.slice({"high.stl@T1", "-p", "two.ini", "-s", "firmware=marlin2", "-s",
                                  "tool_change_at_heights=0.4 = 0; 1.8 = 1", "-s", "adhesion_type=none"});
  const auto lines = lines_of(gcode);
  const auto cooled = std::find(lines.begin(), lines.end(), "M104 T1 S190");
  const auto away = std::find(cooled, lines.end(), "T0");
  REQUIRE(away != lines.end());  // told before it is put away
  const auto heated = std::find(away, lines.end(), "M104 T1 S230");
  const auto done = std::find(heated, lines.end(), "M104 T0 S0");
  const auto back = std::find(heated, lines.end(), "T1");
  REQUIRE(back != lines.end());
  CHECK(std::find(heated, back, ";LAYER_CHANGE") != back);  // in time
  CHECK(done < back);                                       // T0 prints no more
}

TEST_CASE("cli: filaments that do not go together are told, or refused") {
  const Boxes boxes;
  const auto run = weft({"slice", "a.stl", "b.stl@T1", "-o", "out.gcode", "-s", "tool_nozzles=0,0", "-s",
                         "material_print_temperature=210,240", "-s", "material_print_temperature_max=230,auto"},
                        boxes.scratch.path());
  CHECK(run.status == 0);
  CHECK_THAT(run.err, Contains("T1 (PLA) is printed at 240 °C") && Contains("stands 230 °C"));
  CHECK_THAT(boxes.slice({"a.stl", "b.stl@T1", "-s", "tool_nozzles=0,0", "-s", "filament_diameter=1.75,2.85"}, 3),
             Contains("share a nozzle, and are 1.75 and 2.85 mm thick"));
}

TEST_CASE("cli: the bed is as the first tool of the print wants it") {
  const Boxes boxes;
  const auto gcode =
      boxes.slice({"a.stl@T1", "-p", "two.ini", "-s", "material_bed_temperature=60,80", "-s", "firmware=marlin2"});
  CHECK(count_of(gcode, "M190 S80") == 1);
  CHECK(count_of(gcode, "M190 S60") == 0);
}

TEST_CASE("cli: tools are reported with their cost, time and share of the tower") {
  const Boxes boxes;
  boxes.slice({"a.stl", "b.stl@T1", "-s", "tool_nozzles=0,0", "-s", "filament_cost=20,50", "--report", "out.json"});
  const auto report = json::parse(boxes.scratch.read("out.json"));
  const auto& tools = report["tools"];
  REQUIRE(tools.size() == 2);
  CHECK(tools[1]["cost"].get<double>() / tools[1]["filament"]["g"].get<double>() == Approx(0.05).epsilon(0.01));
  CHECK(tools[0]["cost"].get<double>() + tools[1]["cost"].get<double>() ==
        Approx(report["cost"]["filament"].get<double>()).margin(0.002));
  CHECK(tools[0]["s"].get<double>() + tools[1]["s"].get<double>() ==
        Approx(report["print_time_s"].get<double>()).epsilon(0.01));
  const double tower = tools[0]["tower_mm3"].get<double>() + tools[1]["tower_mm3"].get<double>();
  CHECK(tower == Approx(report["features"]["wipe_tower"]["mm3"].get<double>()).epsilon(0.001));
  CHECK(report["purge"]["wanted_mm3"].get<double>() == Approx(10 * 140));
  CHECK(report["purge"]["tower_mm3"].get<double>() >= 10 * 140);
}

TEST_CASE("cli: what is purged goes into infill first, and less of it into the tower") {
  const Boxes boxes;
  boxes.scratch.write("block.stl", box_stl(30, 30, 2));
  const std::vector<std::string> words{"block.stl", "b.stl@T1", "-s", "tool_nozzles=0,0", "--report", "out.json"};
  boxes.slice(words);
  const auto plain = json::parse(boxes.scratch.read("out.json"));
  auto into = words;
  into.insert(into.end(), {"-s", "purge_into_infill=true"});
  boxes.slice(into);
  const auto report = json::parse(boxes.scratch.read("out.json"));
  CHECK(report["purge"]["tower_mm3"].get<double>() < plain["purge"]["tower_mm3"].get<double>());
  CHECK(report["purge"]["infill_mm3"].get<double>() > 0);
  CHECK(report["purge"]["objects_mm3"].get<double>() == 0);
  CHECK(report["features"]["infill"]["mm3"].get<double>() ==
        Approx(plain["features"]["infill"]["mm3"].get<double>()).epsilon(0.001));
  CHECK(report["tools"][1]["filament"]["mm3"].get<double>() - report["tools"][1]["tower_mm3"].get<double>() >
        plain["tools"][1]["filament"]["mm3"].get<double>() - plain["tools"][1]["tower_mm3"].get<double>());
  CHECK(report["audit"]["verdict"] == "pass");
}

TEST_CASE("cli: a print with a tool behind a model, or of parts, is made again byte for byte") {
  const Boxes boxes;
  boxes.scratch.write("inner.stl", box_stl(4, 4, 2));
  boxes.slice({"a.stl+inner.stl@T1", "b.stl@T1", "-p", "two.ini"});
  const auto run = weft({"verify", "out.gcode"}, boxes.scratch.path());
  INFO(run.err);
  CHECK(run.status == 0);
}

TEST_CASE("cli: batch and sweep know tools and parts") {
  const Boxes boxes;
  boxes.scratch.write("inner.stl", box_stl(4, 4, 2));
  boxes.scratch.write("jobs.jsonl", R"({"id":"one","models":["a.stl+inner.stl@T1"]}
{"id":"two","models":["b.stl@T1"]}
)");
  const auto batch = weft({"batch", "jobs.jsonl", "-o", "done", "-p", "two.ini"}, boxes.scratch.path());
  INFO(batch.err);
  REQUIRE(batch.status == 0);
  const auto sweep = weft({"sweep", "b.stl@T1", "-p", "two.ini", "--vary", "layer_height=0.2,0.3", "-o", "swept"},
                          boxes.scratch.path());
  INFO(sweep.err);
  CHECK(sweep.status == 0);
}

TEST_CASE("cli: pictures of a layer by tool") {
  const Boxes boxes;
  boxes.slice({"a.stl", "b.stl@T1", "-p", "two.ini"});
  const auto run =
      weft({"preview", "out.gcode", "-o", "tools.svg", "--colour", "tool", "--layer", "3"}, boxes.scratch.path());
  INFO(run.err);
  REQUIRE(run.status == 0);
  const auto svg = boxes.scratch.read("tools.svg");
  CHECK_THAT(svg, Contains("tool 0") && Contains("tool 1") && Contains("#e69f00") && Contains("#56b4e9"));
}

TEST_CASE("cli: a gradient over the height has the share that is asked for, within 2 % over 20 layers") {
  const Boxes boxes;
  boxes.scratch.write("tall.stl", box_stl(20, 20, 8));
  for (const std::string mode : {"lines", "layers"}) {
    boxes.slice({"tall.stl", "-p", "two.ini", "-s", "gradient_tools=0,1", "-s", "gradient_stops=0:25", "-s",
                 "gradient_mode=" + mode, "-s", "adhesion_type=none", "--report", "out.json", "-s", "top_layers=0",
                 "-s", "bottom_layers=0"});
    const auto report = json::parse(boxes.scratch.read("out.json"));
    REQUIRE(report["tools"].size() == 2);
    const double first = report["tools"][0]["filament"]["mm3"], second = report["tools"][1]["filament"]["mm3"];
    INFO(mode);
    CHECK(second / (first + second) == Approx(0.25).margin(0.02));
  }
}

TEST_CASE("cli: a nozzle that mixes is told its share, and firmware that cannot is refused") {
  const Boxes boxes;
  const std::vector<std::string> words{
      "a.stl", "-s", "gradient_tools=0,1", "-s", "gradient_stops=0:0, 2:100", "-s", "gradient_mode=mix"};
  auto marlin = words, rrf = words, klipper = words;
  marlin.insert(marlin.end(), {"-s", "firmware=marlin2"});
  CHECK_THAT(boxes.slice(marlin), Contains("M163 S0 P0.500\nM163 S1 P0.500\nM164 S0\n"));
  rrf.insert(rrf.end(), {"-s", "firmware=reprapfirmware"});
  CHECK_THAT(boxes.slice(rrf), Contains("M567 P0 E0.000:1.000\n"));
  klipper.insert(klipper.end(), {"-s", "firmware=klipper"});
  CHECK_THAT(boxes.slice(klipper, 3), Contains("gradient_mode: the firmware has no command for a mixing nozzle"));
}

TEST_CASE("cli: a shield stands around everything up to the last change") {
  const Boxes boxes;
  const auto gcode = boxes.slice({"a.stl", "b.stl@T1", "-p", "two.ini", "-s", "ooze_shield_enabled=true", "-s",
                                  "adhesion_type=none", "--report", "out.json"});
  const auto report = json::parse(boxes.scratch.read("out.json"));
  CHECK(report["features"]["skirt"]["mm"].get<double>() > 10 * 80);  // ten layers around two boxes of 10 mm
  CHECK(report["audit"]["verdict"] == "pass");
  const auto brim_of = [&](const char* shield) {
    boxes.slice({"a.stl", "b.stl@T1", "-p", "two.ini", "-s", "adhesion_type=brim", "--report", "out.json", "-s",
                 std::string("ooze_shield_enabled=") + shield});
    return json::parse(boxes.scratch.read("out.json"))["features"]["brim"]["mm"].get<double>();
  };
  CHECK(brim_of("true") == Approx(brim_of("false")));  // the boxes keep theirs
}

TEST_CASE("cli: a filament that the file draws out of a shared nozzle is shaped, parked, and the other pushed in") {
  const Boxes boxes;
  const auto gcode = boxes.slice({"a.stl",    "b.stl@T1",
                                  "-s",       "tool_nozzles=0,0",
                                  "-s",       "firmware=marlin2",
                                  "-s",       "parking_pos_retraction=85",
                                  "-s",       "cooling_tube_retraction=30",
                                  "-s",       "cooling_tube_length=10",
                                  "-s",       "extra_loading_move=-13",
                                  "-s",       "filament_cooling_moves=1",
                                  "-s",       "filament_ramming_parameters=120 100 6.6 6.8 7.2",
                                  "-s",       "retraction_amount=0",
                                  "-s",       "relative_extrusion=true",
                                  "--report", "out.json"});
  // 15 mm, then 70, 20 and 10 % of the 20 mm to the end of the tube, once to and fro, then on to 85 mm; pushed in bit
  // by bit along the tower.
  const auto moves = filament_moves(gcode, "T1");
  CHECK(moves == std::vector<std::string>{"-15 F6000", "-14 F5400", "-4 F2700", "-2 F1620", "10 F132", "-10 F204",
                                          "-50 F2000", "T1", "14.4 F180", "50.4 F1680", "7.2 F168"});
  const auto report = json::parse(boxes.scratch.read("out.json"));
  CHECK(report["audit"]["verdict"] == "pass");
}

TEST_CASE("cli: skirt and brim have a tool of their own where one is named") {
  const Boxes boxes;
  boxes.slice(
      {"a.stl", "-p", "two.ini", "-s", "adhesion_type=brim", "-s", "adhesion_extruder_nr=1", "--report", "out.json"});
  const auto report = json::parse(boxes.scratch.read("out.json"));
  REQUIRE(report["tools"].size() == 2);
  CHECK(report["tools"][1]["filament"]["mm3"].get<double>() ==
        Approx(report["features"]["brim"]["mm3"].get<double>()).epsilon(0.02));
}

TEST_CASE("cli: a profile lists colours, with a comment behind them") {
  const Boxes boxes;
  boxes.scratch.write("colours.ini", "tool_nozzles = 0, 0\nfilament_colour = #202020, #F0F0F0  # dark, light\n");
  boxes.slice({"a.stl", "b.stl@T1", "-p", "colours.ini", "--report", "out.json"});
  const auto report = json::parse(boxes.scratch.read("out.json"));
  const double wanted = report["purge"]["wanted_mm3"];
  CHECK(wanted > 10 * 200);  // ten changes between a dark one and a light one: far from 140 each
}

TEST_CASE("cli: a gradient across a layer has the share of each place") {
  const Boxes boxes;
  boxes.scratch.write("wide.stl", box_stl(40, 20, 6));
  const auto gcode =
      boxes.slice({"wide.stl", "-p", "two.ini", "--keep-position", "-s", "gradient_tools=0,1", "-s", "gradient_axis=x",
                   "-s", "gradient_stops=10:0, 30:100", "-s", "firmware=marlin2", "-s", "relative_extrusion=true", "-s",
                   "adhesion_type=none", "-s", "retraction_amount=0"});
  // Filament of each tool left of 10 mm, and right of 30 mm.
  double laid[2][2] = {};
  double x = 0;
  int tool = 0;
  for (const auto& line : lines_of(gcode)) {
    if (line == "T0" || line == "T1") tool = line[1] - '0';
    if (!line.starts_with("G1") && !line.starts_with("G0")) continue;
    const auto at = line.find(" X"), e = line.find(" E");
    if (at != std::string::npos) x = std::stod(line.substr(at + 2));
    const bool left = x < 5;  // mm: no piece is longer than 10
    const bool right = x > 35;
    const bool goes = at != std::string::npos || line.find(" Y") != std::string::npos;
    if (goes && e != std::string::npos && (left || right)) laid[tool][right ? 1 : 0] += std::stod(line.substr(e + 2));
  }
  CHECK(laid[1][0] < 0.05 * laid[0][0]);  // a twentieth is a step of shares
  CHECK(laid[0][1] < 0.05 * laid[1][1]);
}
