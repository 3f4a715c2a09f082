// SPDX-License-Identifier: GPL-3.0-or-later
// Configurations of printers with several extruders.
#include "prusaslicer/import.h"
#include "settings/tools.h"

#include <algorithm>

#include <catch2/catch.hpp>

using namespace weft;
namespace ps = weft::prusaslicer;
using Catch::Matchers::Contains;

namespace {

ps::Translation translated(const std::string& text) {
  return ps::translate(parse_ini(text, "p.ini"), "p.ini");
}
std::string value_of(const ps::Translation& t, const std::string& key) {
  std::string out = "(absent)";
  for (const auto& a : t.assignments)
    if (a.key == key) out = a.text;
  return out;
}

/// One nozzle, two filaments.
const std::string shared =
    "nozzle_diameter = 0.4,0.4\nsingle_extruder_multi_material = 1\ntemperature = 215,240\n"
    "filament_type = PLA;PETG\nfilament_colour = #FF8000;#DB5182\nretract_length = 0.8\n";

}  // namespace

TEST_CASE("prusaslicer: lists are a tool each, and one that is too short says its first element again") {
  const auto t = translated(shared + "nozzle_diameter = 0.4,0.4,0.6\nfilament_density = 1.24,1.27\n");
  CHECK(value_of(t, "extruders_enabled_count") == "3");
  CHECK(value_of(t, "material_print_temperature") == "215");
  CHECK(value_of(t, "tool.1.material_print_temperature") == "240");
  CHECK(value_of(t, "tool.2.material_print_temperature") == "(absent)");  // 215 again
  CHECK(value_of(t, "tool.1.material_type") == "PETG");
  CHECK(value_of(t, "tool.1.material_density") == "1.27");
  CHECK(value_of(t, "tool.2.nozzle_diameter") == "0.6");
  CHECK(value_of(t, "filament_colour") == "#FF8000");
  CHECK(value_of(t, "tool.1.filament_colour") == "#DB5182");
  CHECK(value_of(t, "tool.1.retraction_amount") == "(absent)");
}

TEST_CASE("prusaslicer: with one extruder nothing is said of tools") {
  const auto t = translated("nozzle_diameter = 0.4\nwipe_tower = 1\nwipe_tower_x = 100\nperimeter_extruder = 1\n");
  for (const auto& a : t.assignments) {
    INFO(a.key);
    CHECK_FALSE(a.key.starts_with("tool"));
    CHECK_FALSE(a.key.starts_with("prime_tower"));
    CHECK(a.key.find("extruder_nr") == std::string::npos);
  }
  CHECK(value_of(t, "extruders_enabled_count") == "(absent)");
}

TEST_CASE("prusaslicer: a shared nozzle, its tower, and how a filament is drawn out of it") {
  const auto t =
      translated(shared +
                 "wipe_tower = 1\nwipe_tower_x = 170\nwipe_tower_y = 125\nwipe_tower_width = 60\n"
                 "wiping_volumes_matrix = 0,120,90,0\nparking_pos_retraction = 85\n"
                 "cooling_tube_retraction = 30\nextra_loading_move = -13\nfilament_loading_speed = 14,20\n"
                 "filament_ramming_parameters = \"120 100 6.6 6.8| 0.05 6.6\";\"130 120 2.7 2.9| 0.05 2.7\"\n"
                 "filament_load_time = 15\nfilament_unload_time = 12\n"
                 "wipe_tower_extra_spacing = 150%\nwipe_tower_extra_flow = 120%\n"
                 "filament_stamping_distance = 0,45\nfilament_stamping_loading_speed = 20,29\n");
  CHECK(value_of(t, "prime_tower_purge_spacing") == "150");
  CHECK(value_of(t, "prime_tower_purge_width") == "120");
  CHECK(value_of(t, "filament_stamping_distance") == "0");
  CHECK(value_of(t, "tool.1.filament_stamping_distance") == "45");
  CHECK(value_of(t, "tool.1.filament_stamping_loading_speed") == "29");
  CHECK(value_of(t, "tool_nozzles") == "0");
  CHECK(value_of(t, "prime_tower_enable") == "true");
  CHECK(value_of(t, "prime_tower_position_x") == "170");
  CHECK(value_of(t, "prime_tower_width") == "60");
  CHECK(value_of(t, "purge_volumes") == "0, 120, 90, 0");
  CHECK(value_of(t, "parking_pos_retraction") == "85");
  CHECK(value_of(t, "extra_loading_move") == "-13");
  CHECK(value_of(t, "tool.1.filament_loading_speed") == "20");
  CHECK_THAT(value_of(t, "filament_ramming_parameters"), Contains("120 100 6.6 6.8"));
  CHECK_THAT(value_of(t, "tool.1.filament_ramming_parameters"), Contains("130 120 2.7 2.9"));
  CHECK(value_of(t, "tool_change_time") == "27");
  CHECK(t.unsupported.empty());
}

TEST_CASE("prusaslicer: a tip that is not shaped, and a length that a vendor wrote with a semicolon") {
  const auto t =
      translated(shared + "wipe_tower = 1\nfilament_ramming_parameters = \"0\"\nretract_length_toolchange = 30;30\n");
  CHECK(value_of(t, "filament_ramming_parameters") == "0");
  CHECK(ramming_flows("0").empty());
  CHECK_THROWS_AS(ramming_flows("0 100 6.6"), std::invalid_argument);
  CHECK(value_of(t, "switch_extruder_retraction_amount") == "30");
  CHECK(value_of(t, "tool.1.switch_extruder_retraction_amount") == "(absent)");
}

TEST_CASE("prusaslicer: volumes of more extruders than there are say what they say of those") {
  const auto t = translated(shared + "wiping_volumes_matrix = 0,120,1,90,0,1,1,1,0\n");
  CHECK(value_of(t, "purge_volumes") == "0, 120, 90, 0");
  CHECK(value_of(translated(shared + "filament_colour = #29B2B2;#29B2B2\n"), "filament_colour") == "(absent)");
}

TEST_CASE("prusaslicer: volumes that are no square, or too few, are told, and left out") {
  const auto t = translated(shared + "wiping_volumes_matrix = 0,140,140,140,0,140\n");
  CHECK(value_of(t, "purge_volumes") == "(absent)");
  const auto told = std::find_if(t.approximated.begin(), t.approximated.end(),
                                 [](const auto& remark) { return remark.key == "wiping_volumes_matrix"; });
  REQUIRE(told != t.approximated.end());
  CHECK_THAT(told->why, Contains("6 numbers for 2 extruders"));
  CHECK(value_of(translated(shared + "wiping_volumes_use_custom_matrix = 0\nwiping_volumes_matrix = 0,9,9,0\n"),
                 "purge_volumes") == "(absent)");
}

TEST_CASE("prusaslicer: features choose extruders, counted from 1, and what all of them have is the object's") {
  const auto all = translated(shared + "perimeter_extruder = 2\ninfill_extruder = 2\nsolid_infill_extruder = 2\n");
  CHECK(value_of(all, "extruder_nr") == "1");
  CHECK(value_of(all, "infill_extruder_nr") == "(absent)");
  const auto some = translated(shared +
                               "perimeter_extruder = 1\ninfill_extruder = 2\nsolid_infill_extruder = 1\n"
                               "support_material_extruder = 0\nsupport_material_interface_extruder = 2\n");
  CHECK(value_of(some, "extruder_nr") == "0");
  CHECK(value_of(some, "infill_extruder_nr") == "1");
  CHECK(value_of(some, "top_bottom_extruder_nr") == "(absent)");
  CHECK(value_of(some, "support_infill_extruder_nr") == "(absent)");
  CHECK(value_of(some, "support_interface_extruder_nr") == "1");
  CHECK_THROWS(translated(shared + "perimeter_extruder = 3\n"));
}

TEST_CASE("prusaslicer: nozzles of their own wait at their temperature unless ooze is prevented") {
  const std::string own =
      "nozzle_diameter = 0.4,0.4\ntemperature = 210,230\nextruder_offset = 0x0,18x-0.5\nretract_length_toolchange = "
      "4,6\n";
  const auto hot = translated(own + "ooze_prevention = 0\n");
  CHECK(value_of(hot, "machine_min_cool_heat_time_window") == "100000");
  CHECK(value_of(hot, "tool_nozzles") == "(absent)");
  CHECK(value_of(hot, "nozzle_offsets") == "0x0, 18x-0.5");
  CHECK(value_of(hot, "switch_extruder_retraction_amount") == "4");
  CHECK(value_of(hot, "tool.1.switch_extruder_retraction_amount") == "6");
  const auto cooled = translated(own + "ooze_prevention = 1\nstandby_temperature_delta = -60\n");
  CHECK(value_of(cooled, "material_standby_temperature") == "150");
  CHECK(value_of(cooled, "tool.1.material_standby_temperature") == "170");
}

TEST_CASE("prusaslicer: filament G-code goes with its filament, with semicolons and quotes in it") {
  const auto t = translated(shared +
                            "start_gcode = G28\\nprint_start\nend_gcode = M84\n"
                            "start_filament_gcode = \"M900 K0.05 ; PLA\";\"M900 K0.08 ; \\\"PETG\\\"\"\n"
                            "end_filament_gcode = \"; done\"\n");
  CHECK(value_of(t, "machine_start_gcode") == "G28\\nprint_start");
  CHECK(value_of(t, "machine_extruder_start_code") == "M900 K0.05 ; PLA");
  CHECK(value_of(t, "tool.1.machine_extruder_start_code") == "M900 K0.08 ; \"PETG\"");
  CHECK(value_of(t, "machine_extruder_end_code") == "; done");
  CHECK(value_of(t, "tool.1.machine_extruder_end_code") == "(absent)");
}

TEST_CASE("prusaslicer: a tower that nobody asked for or forbade stands where filaments share a nozzle") {
  CHECK(value_of(translated(shared), "prime_tower_enable") == "(absent)");
  CHECK(value_of(translated(shared + "wipe_tower = 0\n"), "prime_tower_enable") == "false");
}

TEST_CASE("prusaslicer: a tower stands where a profile says it, of which one half may be PrusaSlicer's own") {
  CHECK(value_of(translated(shared), "prime_tower_position_y") == "(absent)");
  CHECK(value_of(translated(shared + "wipe_tower_x = 60\n"), "prime_tower_position_y") == "140");
}

TEST_CASE("prusaslicer: what a tower stands by, its layers without a change, and how deep paint goes") {
  const auto t = translated(shared +
                            "wipe_tower_cone_angle = 25\nwipe_tower_no_sparse_layers = 1\n"
                            "mmu_segmented_region_max_width = 1.5\n");
  CHECK(value_of(t, "prime_tower_shape") == "cone");
  CHECK(value_of(t, "prime_tower_cone_angle") == "25");
  CHECK(value_of(t, "prime_tower_sparse") == "false");
  CHECK(value_of(t, "paint_depth") == "1.5");
  CHECK(value_of(translated(shared + "mmu_segmented_region_max_width = 0\n"), "paint_depth") == "1000");
}

TEST_CASE("prusaslicer: nozzles of their own are rammed where their filaments say so") {
  const std::string own =
      "nozzle_diameter = 0.4,0.4\nfilament_multitool_ramming = 1,0\nfilament_multitool_ramming_volume = 10,10\n"
      "filament_multitool_ramming_flow = 15,15\n";
  const auto t = translated(own);
  CHECK(value_of(t, "filament_multitool_ramming_volume") == "10");
  CHECK(value_of(t, "filament_multitool_ramming_flow") == "15");
  CHECK(value_of(translated(own + "single_extruder_multi_material = 1\n"), "filament_multitool_ramming_volume") ==
        "(absent)");
}

TEST_CASE("prusaslicer: what is written at a colour change and a pause comes in where a profile says it") {
  const auto t = translated(
      "nozzle_diameter = 0.4\nprinter_technology = FFF\ncolor_change_gcode = M600\\nG1 E0.4 F1500\n"
      "pause_print_gcode = M601\n");
  CHECK(value_of(t, "color_change_gcode") == "M600\\nG1 E0.4 F1500");
  CHECK(value_of(t, "pause_gcode") == "M601");
  CHECK(value_of(translated(shared), "pause_gcode") == "(absent)");
}
