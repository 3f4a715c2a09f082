// SPDX-License-Identifier: GPL-3.0-or-later
#include "gcode/placeholders.h"

#include "core/error.h"
#include "gcode/custom_code.h"
#include "gcode/writer.h"
#include "profile/profile.h"
#include "settings_error.h"
#include "source.h"

#include <filesystem>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::gcode;

namespace {
std::string expanded(std::string_view text, const Settings& settings) {
  auto variables = variables_of(settings);
  variables["first_layer_print_min"] = macro::variable_of("10.5, 20");
  macro::Scope scope;
  macro::Variables globals;
  const macro::Template read(text, "machine_start_gcode");
  read.check(variables, globals);
  return read.expand(variables, scope);
}
std::string expanded(std::string_view text) {
  Settings s;
  s.material.material_type = "PETG";
  return expanded(text, s);
}
std::string message_of(std::string_view text) {
  return weft::test::settings_error([&] { expanded(text); });
}
}  // namespace

TEST_CASE("gcode: placeholders take weft's names and PrusaSlicer's, in braces and brackets") {
  CHECK(expanded("M109 S{material_print_temperature}") == "M109 S210");
  CHECK(expanded("M109 S[temperature]") == "M109 S210");
  CHECK(expanded("M140 S{ first_layer_bed_temperature[0] }") == "M140 S60");
  CHECK(expanded("[first_layer_temperature_0]") == "210");
  CHECK(expanded("X{first_layer_print_min[0]} Y{first_layer_print_min[1]}") == "X10.5 Y20");
  CHECK(expanded("[first_layer_print_min] {first_layer_print_min[1]}") == "10.5 20");
  CHECK(expanded("[first_layer_print_min_1]") == "20");
  CHECK(expanded("{filament_type}") == "PETG");
  CHECK(expanded("{if filament_type[0] == \"PETG\" and layer_height < 0.25}M900 K0.08{else}M900 K0.04{endif}") ==
        "M900 K0.08");
}

TEST_CASE("gcode: custom G-code may say where it has left the nozzle, and changes nothing else") {
  const auto message = [](const std::string& code) {
    Settings s;
    s.gcode.tool_change_gcode = code;
    return weft::test::settings_error([&] { check_custom_code(s); });
  };
  CHECK(message("{position[2] = position[2] + 2; zhop = 0.4; e_retracted[0] = 1}G1 Z{position[2] + zhop}") ==
        "nothing was thrown");
  CHECK(message("{layer_z = 3}").find("'layer_z' cannot be changed") != std::string::npos);
}

TEST_CASE("gcode: names that no profile has are as PrusaSlicer has them") {
  CHECK(expanded("[printer_notes][duplicate_distance] {single_extruder_multi_material}") == "6 false");
}

TEST_CASE("gcode: what is purged, and where, has PrusaSlicer's names too") {
  Settings s;
  s.tools.prime_tower_width = 35_mm;
  s.tools.purge_into_infill = true;
  s.tools.switch_extruder_retraction_amount = 4_mm;
  CHECK(expanded("[wipe_tower_width] [wipe_into_infill] {retract_length_toolchange[0]}", s) == "35 1 4");
  CHECK(expanded("{if is_nil(idle_temperature[0])}off{endif} [wipe_tower_no_sparse_layers]") == "off 0");
}

TEST_CASE("gcode: under PrusaSlicer's names values have PrusaSlicer's units and words") {
  Settings s;
  s.walls.wall_order = WallOrder::outside_in;
  s.cooling.cool_fan_always_on = true;
  s.machine.firmware = Firmware::marlin2;
  CHECK(expanded("{extrusion_multiplier} {material_flow}", s) == "1 100");
  CHECK(expanded("{deretract_speed} {retraction_retract_speed}", s) == "0 40");
  CHECK(expanded("{fan_always_on[0]} [fan_always_on] {cool_fan_always_on}", s) == "true 1 true");
  CHECK(expanded("{gcode_flavor} {firmware}", s) == "marlin2 marlin2");
  CHECK(expanded("{external_perimeters_first} {wall_order}", s) == "1 outside_in");
  CHECK(expanded("{fill_density} [fill_density]", s) == "20 20%");
  CHECK(expanded("{retract_length[0]}", s) == "1");
  s.retraction.retraction_enable = false;
  CHECK(expanded("{retract_length[0]}", s) == "0");
}

TEST_CASE("gcode: a value that has one name in both is written as PrusaSlicer does") {
  CHECK(expanded("[bridge_fan_speed] {bridge_fan_speed[0]} [gap_fill_enabled] {gap_fill_enabled}") == "100 100 1 true");
}

TEST_CASE("gcode: which tools print, of what, and what is purged between them, is told as lists") {
  std::vector<Settings> tools(3);
  tools[0].material.material_type = "PLA", tools[2].material.material_type = "PETG";
  tools[0].material.filament_cost = 20, tools[2].material.filament_cost = 50;  // a kg
  PrintPlan plan;
  plan.layers.resize(1);
  plan.layers[0].height = 200;
  Extrude bead{.path = {}, .role = Role::outer_wall, .height = 200, .speed_mm_s = 50};
  for (const Point p : Ring{{0, 0}, {10'000, 0}, {10'000, 10'000}, {5'000, 2'000}}) bead.path.push_back({p, 400, 1.F});
  plan.layers[0].steps.emplace_back(bead);
  Statistics statistics;
  statistics.tools = {{.filament_mm3 = 1000, .filament_g = 10, .tower_mm3 = 500},
                      {},
                      {.filament_mm3 = 2000, .filament_g = 20, .tower_mm3 = 0}};
  Job job{tools[0], plan, statistics, "x", {}};
  job.tools = tools;
  job.purge_volumes = {0, 1, 2, 3, 0, 5, 6, 7, 0};
  const auto variables = print_variables(job);
  const auto said = [&](const char* text) {
    macro::Scope scope;
    return macro::Template(text, "machine_start_gcode").expand(variables, scope);
  };
  CHECK(said("{is_extruder_used[0]} {is_extruder_used[1]} {is_extruder_used[2]} [num_printing_extruders]") ==
        "true false true 2");
  CHECK(said("[printing_filament_types] [initial_filament_type]") == "PLA,PETG PLA");
  CHECK(said("[total_cost] [total_wipe_tower_filament] [total_wipe_tower_cost]") == "1.2 5 0.1");
  CHECK(said("{wiping_volumes_matrix[2]} {wiping_volumes_matrix[6]} {size(wiping_volumes_matrix)}") == "2 6 9");
  // Half a line of 0.4 mm more than the middle line on every side; what lies within is no corner.
  CHECK(said("{first_layer_print_convex_hull[0]} {size(first_layer_print_convex_hull)}") == "-0.221,-0.221 5");
}

TEST_CASE("gcode: a first-layer value that is auto stands for what it resolves to") {
  CHECK(expanded("{material_print_temperature_layer_0} {initial_layer_height}") == "210 0.2");
}

TEST_CASE("gcode: an unknown placeholder is an error with its line and column, and the nearest name") {
  CHECK(message_of("G28\nM109 S{first_layer_temprature}") ==
        "machine_start_gcode:2:8: unknown placeholder 'first_layer_temprature'; did you mean "
        "'first_layer_temperature'?");
  CHECK(message_of("[nonsense_and_more_nonsense]").find("machine_start_gcode:1:2: unknown placeholder") == 0);
  CHECK(message_of("{first_layer_print_min[2]}").find("has 2 values") != std::string::npos);
  CHECK(message_of("G1 X{1+").find("expected a value") != std::string::npos);
  CHECK(message_of("{machine_reach_z_max}").find("is auto") != std::string::npos);
}

TEST_CASE("gcode: no value smuggles a command in") {
  Settings s;
  s.material.material_type = "PLA\nM104 S300";
  for (const auto* code : {"; {material_type}", "; [material_type]", "; [filament_type]", "; {\"\" + filament_type}"})
    CHECK(expanded(code, s).find('\n') == std::string::npos);
  PrintPlan plan;
  plan.layers.resize(1);
  plan.objects.push_back({"a\nM112 {1+1} [x]", {}, {{0, 0}, {1000, 0}, {0, 1000}}});
  const Statistics none;
  s.gcode.machine_start_gcode = "M117 {input_filename_base} [input_filename_base] {input_filename}\nG28";
  for (const auto dialect : {CommentDialect::prusaslicer, CommentDialect::cura, CommentDialect::orca})
    for (const auto labels : {ObjectLabels::firmware, ObjectLabels::comments}) {
      s.gcode.gcode_comment_dialect = dialect;
      s.gcode.gcode_label_objects = labels;
      const auto text = write({s, plan, none, "x\nM104 S300\r{1+1};[layer_num]\"", {}});
      CHECK(!has_command(text, "M104 S300"));
      CHECK(!has_command(text, "M112"));
      CHECK(text.find("M117 x_M104 S300__1+1___layer_num__ x_M104 S300__1+1___layer_num__ x_M") != std::string::npos);
    }
}

TEST_CASE("gcode: the custom G-code of every profile expands") {
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(tests::source / "profiles/printers")) {
    INFO(entry.path().filename());
    Profile profile;
    apply_file(profile, entry.path());
    CHECK_NOTHROW(check_custom_code(profile.settings));
    ++count;
  }
  CHECK(count >= 5);
}

TEST_CASE("gcode: the example of custom G-code is sound") {
  Profile profile;
  apply_file(profile, tests::source / "examples/custom-gcode.ini");
  CHECK_NOTHROW(check_custom_code(profile.settings));
}
