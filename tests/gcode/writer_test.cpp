// SPDX-License-Identifier: GPL-3.0-or-later
#include "gcode/writer.h"

#include "core/error.h"
#include "gcode/header.h"
#include "model/flow.h"
#include "settings/catalogue.h"
#include "settings_error.h"

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <regex>
#include <sstream>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::gcode;
using Catch::Matchers::Contains;

namespace {
constexpr Um band = 400;

Extrude bead(std::vector<Point> points, Role role, double speed_mm_s, float flow = 1.F) {
  Extrude out{.path = {}, .role = role, .height = 200, .speed_mm_s = speed_mm_s};
  for (const Point p : points) out.path.push_back({p, band, flow});
  return out;
}
Travel travel(std::vector<Point3> path) {
  Travel out{.path = std::move(path)};
  out.speed_mm_s = 150, out.z_speed_mm_s = 10;
  return out;
}

/// Two layers of a square with a line in it, with a lift, fan and one object.
PrintPlan sample_plan() {
  PrintPlan plan;
  for (Um z : {200, 400}) {
    LayerPlan layer{.z = z, .height = 200};
    layer.time.index = layer.time.number = z == 200 ? 0 : 1;
    layer.steps.emplace_back(SetFan{z == 200 ? 0.0 : 0.5});
    layer.steps.emplace_back(travel({{0, 0, z}}));
    layer.steps.emplace_back(ObjectStart{0});
    layer.steps.emplace_back(bead({{0, 0}, {10'000, 0}, {10'000, 10'000}, {0, 10'000}, {0, 0}}, Role::outer_wall, 30));
    layer.steps.emplace_back(Retract{});
    layer.steps.emplace_back(travel({{0, 0, z + 200}, {5'000, 500, z + 200}, {5'000, 500, z}}));
    layer.steps.emplace_back(Prime{});
    layer.steps.emplace_back(bead({{5'000, 500}, {5'000, 9'500}}, Role::infill, 80));
    layer.steps.emplace_back(ObjectEnd{0});
    plan.layers.push_back(std::move(layer));
  }
  plan.objects.push_back({"bracket 1.stl", {5'000, 5'000}, {{0, 0}, {10'000, 0}, {10'000, 10'000}, {0, 10'000}}});
  return plan;
}

Settings plain_settings() {
  Settings s;
  s.retraction.retraction_amount = 800;
  s.gcode.machine_end_gcode = "M84";
  return s;
}

struct Sample {
  Settings settings = plain_settings();
  PrintPlan plan = sample_plan();
  Statistics statistics;
  Sample() {
    statistics.layer_s = {90, 60};
    statistics.print_time_s = 150;
    statistics.filament_mm = 1234.5, statistics.filament_mm3 = 2969.4, statistics.filament_g = 3.682;
  }
  Job job() const { return {settings, plan, statistics, "part", {}}; }
  std::string text() const { return write(job()); }
  std::string layer(std::size_t i) const { return Writer(job()).layer(i); }
  std::string message() const {
    return weft::test::settings_error([&] { Writer writer(job()); });
  }
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// The numbers behind a letter in G0 and G1 lines, in order.
std::vector<double> words(const std::string& text, char letter) {
  std::vector<double> out;
  for (const auto& line : lines_of(text)) {
    if (line.rfind("G0", 0) != 0 && line.rfind("G1 ", 0) != 0) continue;
    const auto at = line.find(std::string(" ") + letter);
    if (at != std::string::npos) out.push_back(std::strtod(line.c_str() + at + 2, nullptr));
  }
  return out;
}
double sum_of(const std::vector<double>& v) {
  double s = 0;
  for (const double x : v) s += x;
  return s;
}
bool has_line(const std::string& text, const std::string& wanted) {
  const auto lines = lines_of(text);
  return std::find(lines.begin(), lines.end(), wanted) != lines.end();
}
std::size_t place(const std::string& text, const std::string& what) {
  const auto at = text.find(what);
  INFO(what);
  CHECK(at != std::string::npos);
  return at;
}
}  // namespace

TEST_CASE("gcode: a layer reads as it should", "[golden]") {
  CHECK(Sample{}.layer(1) ==
        R"(;LAYER_CHANGE
;Z:0.4
;HEIGHT:0.2
;BEFORE_LAYER_CHANGE
;0.4
M73 P60 R1
M106 S128
G0 X0 Y0 Z.4 F9000
M486 S0
;TYPE:External perimeter
;WIDTH:0.443
G1 X10 E.3326 F1800
G1 Y10 E.3326
G1 X0 E.3326
G1 Y0 E.33261
M73 P80 R1
G1 E-.8 F2400
G0 Z.6 F600
G0 X5 Y.5 F9000
G0 Z.4 F600
G1 E.8 F2400
;TYPE:Internal infill
G1 Y9.5 E.29934 F4800
M486 S-1
)");
}

TEST_CASE("gcode: the sum of E is the volume over the filament's cross-section") {
  Sample sample;
  sample.settings.retraction.retraction_amount = 0;
  sample.settings.material.material_flow = 95;
  const double area = std::numbers::pi / 4 * 1.75 * 1.75;
  CHECK(sum_of(words(sample.layer(0), 'E')) == Approx(49 * 0.4 * 0.2 * 0.95 / area).margin(1e-5));
}

TEST_CASE("gcode: rounding of E does not add up over ten thousand short moves") {
  Sample sample;
  std::vector<Point> points;
  for (int i = 0; i <= 10'000; ++i) points.push_back({i * 11, (i % 2) * 3});
  sample.plan.layers.resize(1);
  sample.plan.layers[0].steps = {Step{bead(points, Role::infill, 50)}};
  double mm = 0;
  for (std::size_t i = 1; i < points.size(); ++i) mm += distance(points[i - 1], points[i]) / 1000;
  const double wanted = mm * 0.4 * 0.2 / (std::numbers::pi / 4 * 1.75 * 1.75);
  CHECK(std::abs(sum_of(words(sample.layer(0), 'E')) - wanted) < 1e-5);
  sample.settings.gcode.relative_extrusion = false;
  CHECK(words(sample.layer(0), 'E').back() == Approx(wanted).margin(1e-5));
}

TEST_CASE("gcode: doubled flow, doubled E") {
  Sample sample;
  sample.settings.retraction.retraction_amount = 0;
  const double once = sum_of(words(sample.layer(1), 'E'));
  for (auto& step : sample.plan.layers[1].steps)
    if (auto* b = std::get_if<Extrude>(&step))
      for (auto& j : b->path) j.flow *= 2;
  CHECK(sum_of(words(sample.layer(1), 'E')) == Approx(2 * once).margin(2e-5));
}

TEST_CASE("gcode: what is drawn back is pushed forward again") {
  Sample sample;
  const auto e = words(sample.layer(0), 'E');
  CHECK(std::count(e.begin(), e.end(), -0.8) == 1);
  CHECK(std::count(e.begin(), e.end(), 0.8) == 1);
  sample.settings.retraction.retraction_extra_prime_amount = 50;
  const auto more = words(sample.layer(0), 'E');
  CHECK(std::count(more.begin(), more.end(), 0.85) == 1);
  sample.settings.retraction.firmware_retraction = true;
  sample.settings.retraction.retraction_extra_prime_amount = 0;
  const auto text = sample.layer(0);
  CHECK(has_line(text, "G10"));
  CHECK(has_line(text, "G11"));
  CHECK_THAT(text, !Contains("E-"));
}

TEST_CASE("gcode: a wipe draws back along its path, in sum what a retraction does") {
  Sample sample;
  Retract wipe;
  wipe.wipe = {{0, 1'000}, {0, 2'000}, {500, 2'000}};
  wipe.wipe_speed_mm_s = 120, wipe.before_wipe = 0.25;
  sample.plan.layers[0].steps = {Step{bead({{5'000, 0}, {0, 0}}, Role::outer_wall, 30)}, Step{wipe}, Step{Prime{}}};
  const auto text = sample.layer(0);
  CHECK(place(text, ";WIPE_START") < place(text, ";WIPE_END"));
  CHECK(has_line(text, "G1 E-.2 F2400"));
  double back = 0, forth = 0;
  for (const double e : words(text, 'E')) (e < 0 ? back : forth) += e;
  CHECK(back == Approx(-0.8));
  CHECK(forth == Approx(0.8 + 5 * 0.4 * 0.2 / (std::numbers::pi / 4 * 1.75 * 1.75)).margin(1e-5));
}

TEST_CASE("gcode: with absolute E each layer starts from zero and E never falls but in retractions") {
  Sample sample;
  sample.settings.gcode.relative_extrusion = false;
  CHECK(has_line(sample.text(), "M82"));
  for (const std::size_t i : {0u, 1u}) {
    CHECK(has_line(sample.layer(i), "G92 E0"));
    const auto e = words(sample.layer(i), 'E');
    std::size_t falls = 0;
    for (std::size_t k = 1; k < e.size(); ++k) falls += e[k] < e[k - 1] ? 1u : 0u;
    CHECK(falls == 1);
  }
}

TEST_CASE("gcode: pieces put together are the whole, in whatever order they are written") {
  const Sample sample;
  const auto job = sample.job();
  const Writer writer(job);
  const auto second = writer.layer(1), first = writer.layer(0);
  CHECK(writer.head() + first + second + writer.tail() == write(job));
}

TEST_CASE("gcode: fan, accelerations and labels in each firmware's words") {
  Sample sample;
  for (auto& layer : sample.plan.layers)
    for (auto& step : layer.steps) {
      if (auto* b = std::get_if<Extrude>(&step)) b->acceleration_mm_s2 = b->role == Role::infill ? 2000 : 1000;
      if (auto* t = std::get_if<Travel>(&step)) t->acceleration_mm_s2 = 3000;
    }
  SECTION("Marlin 2") {
    sample.settings.machine.firmware = Firmware::marlin2;
    const auto text = sample.text();
    CHECK(has_line(text, "M106 S128"));
    CHECK(has_line(text, "M107"));
    CHECK(has_line(text, "M204 P1000"));
    CHECK(has_line(text, "M204 P2000"));
    CHECK(has_line(text, "M204 T3000"));
    CHECK(text.find("M204 T3000") == text.rfind("M204 T3000"));  // a value of its own: said once
    CHECK_THAT(text, Contains("M486 T1\nM486 S0\nM486 Abracket_1_stl\nM486 S-1\n"));
    CHECK_THAT(sample.layer(1), Contains("M486 S0\n") && Contains("M486 S-1\n"));
  }
  SECTION("Klipper") {
    sample.settings.machine.firmware = Firmware::klipper;
    const auto text = sample.text();
    CHECK(has_line(text, "M106 S128"));
    CHECK_THAT(text, !Contains("M204") && !Contains("M486"));
    CHECK(has_line(text, "EXCLUDE_OBJECT_DEFINE NAME=bracket_1_stl CENTER=5,5 POLYGON=[[0,0],[10,0],[10,10],[0,10]]"));
    CHECK_THAT(sample.layer(1), Contains("EXCLUDE_OBJECT_START NAME=bracket_1_stl\n") &&
                                    Contains("EXCLUDE_OBJECT_END NAME=bracket_1_stl\n"));
    // One value for everything: it changes between travel and print, also across the change of layers.
    const auto layer = sample.layer(1);
    CHECK(place(layer, "ACCEL=3000") < place(layer, "G0 X0"));
    CHECK(place(layer, "ACCEL=1000") < place(layer, "X10"));
  }
  SECTION("RepRapFirmware") {
    sample.settings.machine.firmware = Firmware::reprapfirmware;
    const auto text = sample.text();
    CHECK(has_line(text, "M106 S0.502"));
    CHECK(has_line(text, "M106 S0"));
    CHECK(has_line(text, "M486 S0 A\"bracket_1_stl\""));
  }
  SECTION("Marlin 1 and Smoothie have one acceleration, and cancel no objects") {
    sample.settings.machine.firmware = GENERATE(Firmware::marlin, Firmware::smoothie);
    const auto text = sample.text();
    CHECK(has_line(text, "M204 S1000"));
    CHECK(has_line(text, "M204 S3000"));
    CHECK_THAT(text, !Contains("M486") && !Contains("M204 P"));
    CHECK(has_line(text, "; printing object bracket_1_stl id:0 copy 0"));
    const auto layer = sample.layer(1);
    CHECK(place(layer, "M204 S3000") < place(layer, "G0 X0"));
    CHECK(place(layer, "M204 S1000") < place(layer, "X10"));
  }
  SECTION("Repetier") {
    sample.settings.machine.firmware = Firmware::repetier;
    const auto text = sample.text();
    CHECK(has_line(text, "M201 X1000 Y1000"));
    CHECK(has_line(text, "M202 X3000 Y3000"));
    CHECK(text.find("M202 X3000") == text.rfind("M202 X3000"));
    CHECK_THAT(text, !Contains("M204") && !Contains("M486") && !Contains("M73"));
  }
  SECTION("comments") {
    sample.settings.gcode.gcode_label_objects = ObjectLabels::comments;
    CHECK(has_line(sample.layer(0), "; printing object bracket_1_stl id:0 copy 0"));
    CHECK(has_line(sample.layer(0), "; stop printing object bracket_1_stl id:0 copy 0"));
  }
  SECTION("none") {
    sample.settings.gcode.gcode_label_objects = ObjectLabels::none;
    CHECK_THAT(sample.text(), !Contains("M486") && !Contains("bracket"));
  }
}

TEST_CASE("gcode: names of objects are one word, distinct, and no longer than firmware takes") {
  std::vector<ObjectLabel> objects(4);
  objects[0].name = objects[1].name = "a b\nM112";
  objects[2].name = std::string(59, 'x') + "ä";
  const auto names = label_names(objects);
  CHECK(names[0] == "a_b_M112");
  CHECK(names[1] == "a_b_M112_2");
  CHECK(names[2] == std::string(59, 'x'));
  CHECK(names[3] == "object");
}

TEST_CASE("gcode: temperatures are set where the start G-code does not") {
  Sample sample;
  auto& s = sample.settings;
  s.material.material_print_temperature_layer_0 = 215;
  s.material.material_bed_temperature_layer_0 = 65;
  SECTION("neither is set") {
    const auto head = Writer(sample.job()).head();
    CHECK(place(head, "M190 S65") < place(head, "G28"));
    CHECK(place(head, "M104 S215") < place(head, "G28"));
    CHECK(place(head, "G28") < place(head, "M109 S215"));
    CHECK_THAT(sample.layer(1), Contains("M104 S210\n") && Contains("M140 S60\n"));
    CHECK_THAT(sample.layer(0), !Contains("M104") && !Contains("M140"));
  }
  SECTION("the nozzle is") {
    s.gcode.machine_start_gcode = "G28\n  m109 S[first_layer_temperature]\nG1 Z5";
    const auto head = Writer(sample.job()).head();
    CHECK_THAT(head, Contains("M190 S65") && !Contains("M104") && !Contains("M109 S215"));
    CHECK_THAT(head, Contains("m109 S215"));
  }
  SECTION("a macro is handed both") {
    s.machine.firmware = Firmware::klipper;
    s.gcode.machine_start_gcode =
        "PRINT_START BED={material_bed_temperature_layer_0} EXTRUDER={material_print_temperature_layer_0}";
    const auto head = Writer(sample.job()).head();
    CHECK_THAT(head, Contains("PRINT_START BED=65 EXTRUDER=215\n") && !Contains("M1"));
  }
  SECTION("a temperature that is only looked at is not set") {
    s.gcode.machine_start_gcode =
        "{if first_layer_temperature[0] > 200}G28{endif}\nM117 {temperature[0]}, {bed_temperature[0]}";
    const auto head = Writer(sample.job()).head();
    CHECK_THAT(head, Contains("M190 S65") && Contains("M104 S215") && Contains("M109 S215"));
  }
  SECTION("a macro is handed it by way of a variable") {
    s.gcode.machine_start_gcode = "{local t = first_layer_temperature[0]}START T={t} B=60";
    CHECK_THAT(Writer(sample.job()).head(), Contains("M190 S65") && !Contains("M109"));
  }
  SECTION("a bed of 0 is left alone") {
    s.material.material_bed_temperature = 0;
    s.material.material_bed_temperature_layer_0.reset();
    CHECK_THAT(sample.text(), !Contains("M140") && !Contains("M190"));
  }
}

TEST_CASE("gcode: custom G-code is expanded for each layer, around the move to it") {
  Sample sample;
  sample.settings.gcode.before_layer_gcode = "; before {layer_num} at [layer_z]";
  sample.settings.gcode.layer_gcode = "; after {layer_num} of {total_layer_count}";
  const auto layer = sample.layer(1);
  CHECK(place(layer, "; before 1 at 0.4") < place(layer, "G0 X0 Y0 Z.4"));
  CHECK(place(layer, "G0 X0 Y0 Z.4") < place(layer, "; after 1 of 2"));
  CHECK(place(layer, "; after 1 of 2") < place(layer, ";TYPE:External perimeter"));
  CHECK(sample.message() == "nothing was thrown");
  sample.settings.gcode.layer_gcode = "M117 {layer_nun}";
  CHECK_THAT(sample.message(), Contains("layer_gcode:1:7: unknown placeholder 'layer_nun'"));
}

TEST_CASE("gcode: custom G-code can be checked before there is anything to print") {
  Settings s;
  CHECK_NOTHROW(check_custom_code(s));
  s.gcode.layer_gcode = "; {layer_z} of {max_layer_z}";
  CHECK_NOTHROW(check_custom_code(s));
  s.gcode.machine_end_gcode = "[nozle_diameter]";
  CHECK_THROWS_WITH(check_custom_code(s),
                    Contains("machine_end_gcode:1:2") && Contains("did you mean 'nozzle_diameter'?"));
}

TEST_CASE("gcode: print variables come from the plan, and the box is that of the strands") {
  Sample sample;
  sample.settings.gcode.machine_start_gcode =
      "; {first_layer_print_min[0]} {first_layer_print_max[1]} {max_layer_z} {total_layer_count} {input_filename_base} "
      "[print_time]";
  CHECK(has_line(sample.text(), "; -0.221 10.221 0.4 2 part 2m 30s"));
}

TEST_CASE("gcode: start G-code of Cura's finds its names") {
  Sample sample;
  sample.settings.gcode.machine_start_gcode =
      "; {material_print_temperature_layer_0} {material_bed_temperature_layer_0} {machine_width} {machine_depth}\n"
      "; {machine_nozzle_size} {layer_height_0} {material_diameter} {retraction_amount} {retraction_speed} "
      "{speed_travel}\n"
      "; {initial_extruder_nr} {jobname} {filament_amount} {filament_weight} {material_type}";
  const auto text = sample.text();
  CHECK(has_line(text, "; 210 60 220 220"));
  CHECK(has_line(text, "; 0.4 0.2 1.75 0.8 40 150"));
  CHECK(has_line(text, "; 0 part 1.23 3.68 PLA"));
}

TEST_CASE("gcode: speeds change only where they change, and lifts are as slow as Z needs") {
  const auto f = words(Sample{}.layer(0), 'F');
  // up and first travel (from an unknown place), wall, retraction, lift, travel, descent, priming, infill
  CHECK(f == std::vector<double>{600, 9000, 1800, 2400, 600, 9000, 600, 2400, 4800});
}

TEST_CASE("gcode: flow ratios are written when asked") {
  Sample sample;
  sample.plan.layers[0].steps = {Step{bead({{0, 0}, {10'000, 0}}, Role::inner_wall, 30, 0.25F)}};
  CHECK_THAT(sample.layer(0), !Contains("; flow"));
  sample.settings.gcode.gcode_flow_comments = true;
  CHECK_THAT(sample.layer(0), Contains(" ; flow 0.25\n"));
}

TEST_CASE("gcode: widths are rounded line widths, said where they change") {
  Sample sample;
  Extrude wedge{.path = {}, .role = Role::inner_wall, .height = 200, .speed_mm_s = 30};
  for (Um i = 0; i <= 9; ++i) wedge.path.push_back({{i * 1000, 0}, flow::band(450, 200) + (i < 3 ? 0 : 12 * i), 1.F});
  sample.plan.layers[0].steps = {Step{wedge}};
  const auto text = sample.layer(0);
  const std::regex line(";WIDTH:([^\n]*)");
  std::vector<double> found;
  for (auto it = std::sregex_iterator(text.begin(), text.end(), line); it != std::sregex_iterator(); ++it)
    found.push_back(std::stod((*it)[1]));
  REQUIRE(found.size() >= 4);
  CHECK(found.size() < 9);  // not at every step of 12 µm
  CHECK(found[0] == 0.45);
  for (std::size_t i = 1; i < found.size(); ++i) CHECK(found[i] - found[i - 1] > 0.0199);
  CHECK(found.back() == Approx(0.558).margin(0.021));
}

TEST_CASE("gcode: machine limits are said in each firmware's commands, when asked") {
  Sample sample;
  auto& m = sample.settings.machine;
  m.machine_max_jerk = 8, m.machine_max_speed_z = 12.5;
  CHECK_THAT(sample.text(), !Contains("M203"));
  sample.settings.gcode.gcode_machine_limits = true;
  SECTION("Marlin 1") {
    m.firmware = Firmware::marlin;
    CHECK_THAT(Writer(sample.job()).head(),
               Contains("M201 X3000 Y3000 Z100 E5000\nM203 X300 Y300 Z12.5 E60\nM205 X8\n"));
  }
  SECTION("Marlin 2") {
    CHECK(has_line(sample.text(), "M205 X8 Y8"));
    m.machine_junction_deviation = 0.013;
    CHECK(has_line(sample.text(), "M205 J0.013"));
    CHECK_THAT(sample.text(), !Contains("M205 X"));
  }
  SECTION("RepRapFirmware counts in minutes") {
    m.firmware = Firmware::reprapfirmware;
    CHECK_THAT(Writer(sample.job()).head(),
               Contains("M201 X3000 Y3000 Z100 E5000\nM203 X18000 Y18000 Z750 E3600\nM566 X480 Y480\n"));
  }
  SECTION("Repetier's M203 watches temperatures") {
    m.firmware = Firmware::repetier;
    CHECK_THAT(Writer(sample.job()).head(), Contains("M201 X3000 Y3000 Z100 E5000\nM207 X8\n") && !Contains("M203"));
  }
  SECTION("Smoothie") {
    m.firmware = Firmware::smoothie;
    m.machine_junction_deviation = 0.05;
    CHECK_THAT(Writer(sample.job()).head(), Contains("M203 X300 Y300 Z12.5\nM205 X0.05\n") && !Contains("M201"));
  }
  SECTION("Klipper has none") {
    m.firmware = Firmware::klipper;
    CHECK_THAT(sample.text(), !Contains("M201") && !Contains("M203") && !Contains("M205"));
  }
}

TEST_CASE("gcode: the chamber is heated where the start G-code does not, and waiting is a choice") {
  Sample sample;
  auto& m = sample.settings.material;
  CHECK_THAT(sample.text(), !Contains("M141") && !Contains("M191"));
  m.build_volume_temperature = 45;
  const auto head = Writer(sample.job()).head();
  CHECK(place(head, "M141 S45") < place(head, "M190 S60"));
  CHECK(place(head, "M190 S60") < place(head, "M191 S45"));
  CHECK(place(head, "M191 S45") < place(head, "G28"));
  m.build_volume_wait_temperature = 30;  // M191 makes it the target
  CHECK_THAT(Writer(sample.job()).head(), Contains("M191 S30\nM141 S45\nG28"));
  m.build_volume_wait_temperature = 0;
  CHECK_THAT(Writer(sample.job()).head(), Contains("M141 S45") && !Contains("M191"));
  m.build_volume_wait_temperature.reset();
  m.material_bed_temp_wait = m.material_print_temp_wait = false;
  const auto eager = Writer(sample.job()).head();
  CHECK_THAT(eager, Contains("M141 S45\nM140 S60\nM104 S210\nG28\n") && !Contains("M190") && !Contains("M191") &&
                        !Contains("M109"));
  sample.settings.gcode.machine_start_gcode = "START CHAMBER={chamber_temperature[0]}";
  CHECK_THAT(Writer(sample.job()).head(), Contains("START CHAMBER=45") && !Contains("M141"));
}

TEST_CASE(
    "gcode: substitutions reach everything between the comments of the head and those of the end, and nothing else") {
  Sample sample;
  sample.settings.gcode.machine_start_gcode = "G28 ; weft";
  sample.settings.gcode.machine_end_gcode = "M84 ; weft";
  const auto before = sample.text();
  sample.settings.gcode.gcode_substitutions = "s/weft/wove/\ns/^;LAYER_CHANGE\\n//r";
  const auto after = sample.text();
  CHECK_THAT(after, Contains("; generated by weft ") && Contains("G28 ; wove") && Contains("M84 ; wove"));
  CHECK_THAT(before, Contains("\n;LAYER_CHANGE"));
  CHECK_THAT(after, !Contains("\n;LAYER_CHANGE"));
  CHECK_THAT(after, Contains("; gcode_substitutions = s/weft/wove/"));
  sample.settings.gcode.gcode_substitutions = "s/(//r";
  CHECK_THAT(sample.message(), Contains("gcode_substitutions, line 1"));
}

TEST_CASE("gcode: between objects that are printed one after the other there is G-code of its own") {
  Sample sample;
  const auto layers = sample.plan.layers;
  sample.plan.layers.insert(sample.plan.layers.end(), layers.begin(), layers.end());
  for (std::uint32_t i = 0; i < 4; ++i) sample.plan.layers[i].time = {i, i / 2, i % 2, i == 2};
  sample.statistics.layer_s = {90, 60, 90, 60};
  sample.settings.gcode.between_objects_gcode = "; next object, {layer_num}";
  sample.settings.gcode.before_layer_gcode = "; before";
  sample.settings.gcode.tool_change_gcode = "T{next_extruder}";
  for (const std::size_t i : {0u, 1u, 3u}) CHECK_THAT(sample.layer(i), !Contains("; next object"));
  CHECK_THAT(sample.layer(2), Contains("; next object, 2\n; before\n"));
  CHECK_THAT(sample.text(), !Contains("\nT0"));
  sample.settings.gcode.tool_change_gcode = "T{nxt_extruder}";
  CHECK_THAT(sample.message(),
             Contains("tool_change_gcode:1:3: unknown placeholder 'nxt_extruder'") && Contains("'next_extruder'"));
}

TEST_CASE("gcode: global variables count through the layers, and random numbers are the same again") {
  Sample sample;
  sample.settings.gcode.machine_start_gcode = "{global seen = 0}; {random(0, 1000000)}";
  sample.settings.gcode.before_layer_gcode = "{seen = seen + 1}; seen {seen}";
  sample.settings.gcode.machine_end_gcode = "; in all {seen}, {layer_num}";
  const auto text = sample.text();
  CHECK(has_line(text, "; seen 1"));
  CHECK(has_line(text, "; seen 2"));
  CHECK(has_line(text, "; in all 2, 1"));
  CHECK(text == sample.text());
}

TEST_CASE("gcode: what would differ from run to run has no value, but may be given one") {
  Settings s;
  s.gcode.machine_start_gcode = "; {timestamp}";
  CHECK_THROWS_WITH(check_custom_code(s),
                    Contains("machine_start_gcode:1:4: 'timestamp' would differ from run to run"));
}

TEST_CASE("gcode: a division that may be by zero is not told before the print is known") {
  Settings s;
  s.gcode.layer_gcode = "; {100 / (total_layer_count - 100)}";
  CHECK_NOTHROW(check_custom_code(s));
  s.gcode.layer_gcode = "{if layer_num > 1000}{\"a\" * 2}{endif}{true and 5}";
  CHECK_THROWS_WITH(check_custom_code(s), Contains("layer_gcode") && Contains("neither true nor false"));
}

TEST_CASE("gcode: a thumbnail is a PNG in base64, in rows of 78, with its length") {
  Sample sample;
  auto job = sample.job();
  job.thumbnails.push_back({16, 8, std::string("\x89PNG\r\n\x1a\n", 8) + std::string(101, 'a')});
  const auto head = Writer(job).head();
  CHECK_THAT(head, Contains("; thumbnail begin 16x8 148\n; iVBORw0KGgphYWFh"));
  CHECK_THAT(head, Contains("==\n; thumbnail end\n"));
  for (const auto& line : lines_of(head)) CHECK(line.size() <= 120);
  const auto begin = head.find("148\n") + 4, end = head.find("; thumbnail end");
  std::size_t characters = 0;
  for (const auto& line : lines_of(head.substr(begin, end - begin))) {
    characters += line.size() - 2;
    CHECK(line.size() <= 80);
  }
  CHECK(characters == 148);
}

TEST_CASE("gcode: the header says layers and extents, and leaves a line for the audit") {
  const auto head = Writer(Sample{}.job()).head();
  const auto lines = lines_of(head);
  CHECK(lines[1] + "\n" == audit_pending);
  for (const auto* line : {";LAYER_COUNT:2", ";MINX:0", ";MINY:0", ";MINZ:0.2", ";MAXX:10", ";MAXY:10", ";MAXZ:0.6"})
    CHECK(has_line(head, line));
}

TEST_CASE("gcode: the settings stand at the end and are read back alike") {
  Sample sample;
  sample.settings.gcode.machine_start_gcode = "G28\nG29 ; mesh";
  sample.settings.layers.layer_height = 150;
  const auto text = sample.text();
  Settings back;
  const auto lines = lines_of(text);
  auto line = std::find(lines.begin(), lines.end(), "; weft_settings = begin");
  REQUIRE(line != lines.end());
  for (++line; line != lines.end() && *line != "; weft_settings = end"; ++line) {
    const auto eq = line->find(" = ");
    const auto* entry = find_setting(line->substr(2, eq - 2));
    REQUIRE(entry != nullptr);
    entry->parse(back, line->substr(eq + 3));
  }
  CHECK(lines.back() == "; weft_settings = end");
  CHECK(as_text(back) == as_text(sample.settings));
}

TEST_CASE("gcode: an empty plan is a file without layers") {
  Sample sample;
  sample.plan = {};
  sample.statistics = {};
  CHECK_THAT(sample.text(), Contains(";LAYER_COUNT:0\n") && Contains("; estimated printing time (normal mode) = 0s\n"));
}

TEST_CASE("gcode: widths and heights in comments are those of what is extruded") {
  Sample sample;
  Extrude strand = bead({{0, 0}, {10'000, 0}}, Role::bridge, 30, static_cast<float>(flow::bridge_flow(400, 200)));
  sample.plan.layers[0].steps = {Step{strand}};
  CHECK_THAT(sample.layer(0), Contains(";HEIGHT:0.4\n;WIDTH:0.4\n"));  // a round strand of the nozzle's diameter
  sample.plan.layers[0].steps = {Step{bead({{0, 0}, {10'000, 0}}, Role::outer_wall, 30, 0.25F)}};
  CHECK_THAT(sample.layer(0), Contains(";WIDTH:0.1\n"));  // a quarter of the band: narrower than high, not rounded
  sample.plan.layers[0].steps = {Step{bead({{0, 0}, {10'000, 0}}, Role::infill, 30, 2.F)}};
  CHECK_THAT(sample.layer(0), Contains(";HEIGHT:0.4\n;WIDTH:0.486\n"));  // of two layers at once
}

TEST_CASE("gcode: E is in mm³ or left out when asked") {
  Sample sample;
  const double in_mm = [&] {
    const auto text = sample.layer(0);
    return std::stod(text.substr(text.find(" E") + 2));
  }();
  sample.settings.gcode.volumetric_extrusion = true;
  const auto text = sample.layer(0);
  CHECK(std::stod(text.substr(text.find(" E") + 2)) ==
        Approx(in_mm * std::numbers::pi / 4 * 1.75 * 1.75).epsilon(1e-3));
  CHECK_THAT(text, Contains("G1 E-1.924"));  // 0.8 mm of filament
  sample.settings.gcode.write_extrusion = false;
  CHECK_THAT(sample.layer(0) + Writer(sample.job()).head(), !Contains(" E") && !Contains("M83"));
}
