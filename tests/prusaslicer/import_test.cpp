// SPDX-License-Identifier: GPL-3.0-or-later
#include "prusaslicer/import.h"

#include "core/error.h"
#include "prusaslicer/keys.h"
#include "prusaslicer/orca.h"
#include "settings/catalogue.h"
#include "source.h"

#include <algorithm>
#include <fstream>
#include <set>

#include <catch2/catch.hpp>

using namespace weft;
namespace ps = weft::prusaslicer;

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
}  // namespace

TEST_CASE("prusaslicer: every key has one row, and every setting that a row names exists") {
  std::set<std::string_view> seen;
  for (const auto& row : ps::keys()) {
    INFO(row.name);
    CHECK(seen.insert(row.name).second);
    CHECK(ps::find_key(row.name) == &row);
    if (!row.ours.empty()) CHECK(find_setting(row.ours) != nullptr);
    CHECK((row.form == ps::Form::speed || row.of.empty()));
    if (!row.of.empty()) CHECK(seen.count(row.of) == 1);  // reckoned before it
    CHECK((row.automatic > 0) == (row.form == ps::Form::width));
  }
  CHECK(seen.size() > 370);
  CHECK(ps::find_key("wall_line_count") == nullptr);
}

TEST_CASE("prusaslicer: each key that a preset of PrusaSlicer 2.9.4 holds has a fate") {
  std::ifstream names(tests::source / "tests/data/prusaslicer/keys-2.9.4.txt");
  std::string name;
  std::size_t count = 0;
  for (; names >> name; ++count) {
    INFO(name);
    const auto* row = ps::find_key(name);
    if (!row && name.starts_with("filament_")) {  // a filament's own value of a printer's key
      row = ps::find_key(std::string_view(name).substr(9));
      CHECK((row && row->of_filament));
    }
    CHECK(row != nullptr);
  }
  CHECK(count == 367);
}

TEST_CASE("prusaslicer: walls over air have the speeds and fans that the profile gives each share of their width") {
  const auto plain = translated("overhangs = 1\nbridge_speed = 35\nenable_dynamic_fan_speeds = 0\n");
  CHECK(value_of(plain, "speed_overhang") == "35");
  CHECK(value_of(plain, "speed_overhang_75") == "100%");
  CHECK(value_of(plain, "overhang_fan_speed_75") == "0");
  CHECK(value_of(plain, "overhang_walls") == "true");
  CHECK(value_of(translated("overhangs = 0\nbridge_speed = 35\n"), "overhang_walls") == "false");
  CHECK(value_of(translated("bridge_speed = 35\n"), "speed_overhang") == "35");
  const auto by_share = translated(
      "overhangs = 1\nenable_dynamic_overhang_speeds = 1\noverhang_speed_0 = 12\noverhang_speed_1 = 20%\n"
      "overhang_speed_2 = 30\noverhang_speed_3 = 0\nenable_dynamic_fan_speeds = 1\noverhang_fan_speed_0 = 90\n"
      "overhang_fan_speed_1 = 80\noverhang_fan_speed_2 = 70\noverhang_fan_speed_3 = 60\n");
  CHECK(value_of(by_share, "speed_overhang") == "12");
  CHECK(value_of(by_share, "speed_overhang_100") == "12");
  CHECK(value_of(by_share, "speed_overhang_75") == "20%");
  CHECK(value_of(by_share, "speed_overhang_50") == "30");
  CHECK(value_of(by_share, "speed_overhang_25") == "100%");
  CHECK(value_of(by_share, "overhang_fan_speed_100") == "90");
  CHECK(value_of(by_share, "overhang_fan_speed_25") == "60");
}

TEST_CASE("prusaslicer: how fast flow may grow and fall are two limits, and 0 is none") {
  const auto slopes = [](const std::string& positive, const std::string& negative) {
    const auto t = translated("max_volumetric_extrusion_rate_slope_positive = " + positive +
                              "\nmax_volumetric_extrusion_rate_slope_negative = " + negative + "\n");
    return value_of(t, "max_extrusion_rate_slope") + " " + value_of(t, "max_extrusion_rate_slope_down");
  };
  CHECK(slopes("100", "60") == "100 60");
  CHECK(slopes("0", "60") == "auto 60");
  CHECK(slopes("50", "0") == "50 100000");
  CHECK(slopes("0", "0") == "auto auto");
}

TEST_CASE("prusaslicer: the second values of all limits are those of silent mode") {
  std::string lines = "gcode_flavor = marlin\nsilent_mode = 1\n";
  for (const char* axis : {"x", "y", "z", "e"})
    lines +=
        std::string("machine_max_feedrate_") + axis + " = 200,100\nmachine_max_acceleration_" + axis + " = 1250,960\n";
  lines += "machine_max_jerk_x = 8,7\nmachine_max_jerk_y = 8,7\nmachine_max_jerk_z = 0.4,0.3\n";
  const std::string last = "machine_max_jerk_e = 4.5,2.5\n";
  CHECK(value_of(translated(lines + last), "machine_silent_limits") ==
        "100, 100, 100, 100, 960, 960, 960, 960, 7, 0.3, 2.5");
  CHECK(translated(lines + last).unknown.empty());
  CHECK(value_of(translated("gcode_flavor = marlin2" + lines.substr(lines.find('\n')) + last),
                 "machine_silent_limits") == "100, 100, 100, 100, 960, 960, 960, 960, 7, 0.3, 2.5");
  CHECK(value_of(translated(lines + "machine_max_jerk_e = 4.5\n"), "machine_silent_limits") == "(absent)");
  auto off = lines + last;
  off.replace(off.find("silent_mode = 1"), 15, "silent_mode = 0");
  CHECK(value_of(translated(off), "machine_silent_limits") == "(absent)");
}

TEST_CASE("prusaslicer: arcs stand off their moves by gcode_resolution") {
  CHECK(value_of(translated("arc_fitting = emit_center\ngcode_resolution = 0.02\n"), "arc_tolerance") == "0.02");
  CHECK(value_of(translated("arc_fitting = emit_center\ngcode_resolution = 0\n"), "arc_tolerance") == "0.001");
  CHECK(value_of(translated("arc_fitting = disabled\ngcode_resolution = 0.02\n"), "arc_tolerance") == "(absent)");
  CHECK(value_of(translated("arc_fitting = emit_center\ngcode_resolution = 0.02\n"), "resolution") == "0.02");
}

TEST_CASE("prusaslicer: what layers of varying height may be is said for adaptive ones") {
  const auto t = translated("min_layer_height = 0.05\nmax_layer_height = 0\n");
  CHECK(value_of(t, "adaptive_layer_height_min") == "0.05");
  CHECK(value_of(t, "adaptive_layer_height_max") == "auto");
  CHECK(value_of(translated("min_layer_height = 0\nmax_layer_height = 0.25\n"), "adaptive_layer_height_min") == "0.02");
  CHECK(value_of(translated("max_layer_height = 0.25\n"), "adaptive_layer_height_max") == "0.25");
}

TEST_CASE("prusaslicer: rough walls, vases, ironing and single walls become what they are here") {
  const auto t = translated(
      "fuzzy_skin = all\nironing = 1\nironing_type = solid\nironing_flowrate = 12%\nironing_spacing = "
      "0.2\nironing_speed "
      "= 22\nspiral_vase = 1\ntop_one_perimeter_type = topmost\narc_fitting = emit_center\nmachine_max_jerk_e = 0,0\n");
  CHECK(value_of(t, "magic_fuzzy_skin_enabled") == "true");
  CHECK(value_of(t, "magic_fuzzy_skin_outside_only") == "false");
  CHECK(value_of(t, "ironing_enabled") == "true");
  CHECK(value_of(t, "ironing_surfaces") == "solid");
  CHECK(value_of(t, "ironing_flow") == "12");
  CHECK(value_of(t, "ironing_line_spacing") == "0.2");
  CHECK(value_of(t, "speed_ironing") == "22");
  CHECK(value_of(t, "magic_spiralize") == "true");
  CHECK(value_of(t, "top_one_wall") == "topmost");
  CHECK(value_of(t, "arc_fitting") == "true");
  CHECK(value_of(t, "machine_max_jerk_e") == "auto");
  CHECK(value_of(translated("fuzzy_skin = none\n"), "magic_fuzzy_skin_enabled") == "false");
  CHECK_THROWS_WITH(translated("fuzzy_skin = some\n"), Catch::Matchers::Contains("one of none, external, all"));
}

TEST_CASE("prusaslicer: a lift on the way has its slope and height") {
  const auto t = translated("travel_ramping_lift = 1\ntravel_max_lift = 0.6\ntravel_slope = 3\nretract_lift = 0.2\n");
  CHECK(value_of(t, "retraction_hop_type") == "slope");
  CHECK(value_of(t, "retraction_hop") == "0.6");
  CHECK(value_of(t, "travel_slope") == "3");
  const auto off = translated("travel_ramping_lift = 0\ntravel_max_lift = 0.6\nretract_lift = 0.2\n");
  CHECK(value_of(off, "retraction_hop") == "0.2");
  CHECK(value_of(off, "retraction_hop_type") == "(absent)");
}

TEST_CASE("prusaslicer: a key's fate is what its part of the table says") {
  for (const auto& row : ps::ported_keys()) {
    INFO(row.name);
    CHECK_FALSE(row.ours.empty());
    CHECK((row.form > ps::Form::none && row.form < ps::Form::width));
  }
  for (const auto& row : ps::reckoned_keys()) {
    INFO(row.name);
    CHECK(row.form >= ps::Form::width);
    CHECK_FALSE((row.ours.empty() && row.fate.empty()));
  }
  for (const auto& row : ps::idle_keys()) {
    INFO(row.name);
    CHECK(row.form == ps::Form::none);
    CHECK_FALSE((row.fate.empty() || row.neutral));
  }
  for (const auto& row : ps::missing_keys()) {
    INFO(row.name);
    CHECK(row.form == ps::Form::none);
    CHECK_FALSE(row.fate.empty());
    CHECK(row.neutral);
  }
}

TEST_CASE("prusaslicer: a setting is called by the first key that means it") {
  CHECK(ps::name_of("wall_line_count") == "perimeters");
  CHECK(ps::name_of("speed_wall_0") == "external_perimeter_speed");
  CHECK(ps::name_of("machine_max_speed_z") == "machine_max_feedrate_z");
  CHECK(ps::name_of("nozzle_offsets") == "extruder_offset");
  CHECK(ps::name_of("flow_compensation").empty());
  CHECK(ps::name_of("").empty());
}

TEST_CASE("prusaslicer: its files are told by what stands in them") {
  const auto recognised = [](const std::string& text) { return ps::recognises(text, parse_ini(text, "p.ini")); };
  CHECK(recognised("# generated by PrusaSlicer 2.9.4 on 2025-01-01 at 00:00:00 UTC\n\nlayer_height = 0.2\n"));
  CHECK(recognised("perimeters = 3\nfill_density = 20%\n"));
  CHECK_FALSE(recognised("layer_height = 0.2\nwall_line_count = 3\n"));
  CHECK_FALSE(recognised("layer_height = 0.2\nperimeters = 3\n"));
}

TEST_CASE("prusaslicer: shares are taken of what PrusaSlicer takes them of") {
  const auto t = translated(
      "layer_height = 0.2\nnozzle_diameter = 0.4\nfirst_layer_height = 75%\nextrusion_width = "
      "0\nperimeter_extrusion_width = 0\n"
      "external_perimeter_extrusion_width = 200%\ntop_infill_extrusion_width = 0\nperimeter_speed = "
      "60\nexternal_perimeter_speed = 50%\n"
      "infill_speed = 80\nsolid_infill_speed = 25%\ntop_solid_infill_speed = 50%\nfill_density = "
      "15%\nextrusion_multiplier = 0.95\n");
  CHECK(value_of(t, "initial_layer_height") == "0.15");
  CHECK(value_of(t, "wall_line_width_x") == "0.45");
  CHECK(value_of(t, "wall_line_width_0") == "0.4");
  CHECK(value_of(t, "top_skin_line_width") == "0.4");
  CHECK(value_of(t, "speed_wall_0") == "30");
  CHECK(value_of(t, "speed_topbottom") == "20");
  CHECK(value_of(t, "speed_top_skin") == "10");
  CHECK(value_of(t, "infill_sparse_density") == "15");
  CHECK(value_of(t, "material_flow") == "95");
}

TEST_CASE("prusaslicer: zero means automatic, unlimited or never, and is said so") {
  const auto t = translated(
      "bridge_angle = 0\nderetract_speed = 0\nretract_length = 0\nmax_volumetric_speed = 0\nperimeter_speed = "
      "0\nmax_print_speed = 70\n");
  CHECK(value_of(t, "bridge_angle") == "auto");
  CHECK(value_of(t, "retraction_prime_speed") == "auto");
  CHECK(value_of(t, "retraction_enable") == "false");
  CHECK(value_of(t, "material_max_volumetric_speed") == "500");
  CHECK(value_of(t, "speed_wall_x") == "70");
  CHECK(t.approximated.empty());  // at most max_print_speed, as PrusaSlicer's automatic speed without a limit of flow
}

TEST_CASE("prusaslicer: a list of a filament's that is empty says nothing, and a number that is empty is refused") {
  const auto t = translated("filament_cost = \nderetract_speed =\nfilament_retract_length = \nretract_length = 1.2\n");
  CHECK(value_of(t, "filament_cost") == "(absent)");
  CHECK(value_of(t, "retraction_amount") == "1.2");
  CHECK_THROWS_AS(translated("layer_height = \n"), Error);
}

TEST_CASE("prusaslicer: of vectors the first value holds, and beds of any shape are kept") {
  const auto t = translated(
      "temperature = 215,230\nmachine_max_feedrate_x = 500,200\nbed_shape = "
      "0x0,250x0,250x210,0x210\nmachine_max_acceleration_e = 5000,2000\n");
  CHECK(value_of(t, "material_print_temperature") == "215");
  CHECK(value_of(t, "machine_max_speed_x") == "500");
  CHECK(value_of(t, "bed_shape") == "rectangle");
  CHECK(value_of(t, "machine_depth") == "210");
  const auto centred = translated("bed_shape = -50x-50,50x-50,50x50,-50x50\n");
  CHECK(value_of(centred, "bed_shape") == "rectangle");
  CHECK(value_of(centred, "machine_center_is_zero") == "true");
  CHECK(value_of(translated("bed_shape = -50x-40,50x-50,50x50,-50x50\n"), "bed_shape") == "polygon");
}

TEST_CASE("prusaslicer: filament G-code is laid between the printer's and the print, quoted or not") {
  const auto t = translated("start_gcode = G28\\nG1 Z5\nstart_filament_gcode = \"M900 K0.05 ; \\\"LA\\\"\"\n");
  CHECK(value_of(t, "machine_start_gcode") == "G28\\nG1 Z5\\nM900 K0.05 ; \"LA\"");
}

TEST_CASE("prusaslicer: what has no effect is listed when it would change the print, and only then") {
  const auto t = translated(
      "over_bridge_speed = 30\nextra_perimeters_on_overhangs = 0\navoid_crossing_curled_overhangs = 1\nperimeters = "
      "2\nprinter_notes = mine\nno_such_key = "
      "1\nfilament_retract_length = nil\n");
  REQUIRE(t.unsupported.size() == 2);
  CHECK(t.unsupported[0].key == "over_bridge_speed");
  CHECK(t.unsupported[1].key == "avoid_crossing_curled_overhangs");
  REQUIRE(t.unknown.size() == 1);
  CHECK(t.unknown[0].line == 6);
  CHECK(t.not_needed.size() == 2);
}

TEST_CASE("prusaslicer: substitutions in the G-code become weft's lines, with flags and groups") {
  const auto setting_of = [](const std::string& value) {
    return value_of(translated("gcode_substitutions = " + value + "\n"), "gcode_substitutions");
  };
  CHECK(setting_of("") == "");
  CHECK(setting_of("M204;M205;\"\";\"\"") == "s/M204/M205/");
  CHECK(setting_of("\"a/b; c\";\"\";\"wi\";\"a note\"") == "s|a/b; c||wi");
  // Two of them; a backslash of an expression is doubled in either file.
  CHECK(setting_of(R"("^G1 F(\\d+)\\n";"G1 F\\1\\n";"r";"";"x";"y";"";"")") ==
        R"(s/^G1 F(\\d+)\\n/G1 F$1\\n/r\ns/x/y/)");
}

TEST_CASE("prusaslicer: what bounds or replaces a speed or a width by itself does so") {
  const std::string speeds = "infill_speed = 80\nsolid_infill_speed = 50%\n";
  CHECK(value_of(translated(speeds + "first_layer_infill_speed = 50%\n"), "speed_topbottom_layer_0") == "20");
  CHECK(value_of(translated(speeds + "first_layer_infill_speed = 0\n"), "speed_topbottom_layer_0") == "auto");
  const std::string bounds = speeds + "filament_infill_max_speed = 70\nfilament_infill_max_crossing_speed = 40\n";
  CHECK(value_of(translated(bounds + "fill_pattern = gyroid\n"), "speed_infill") == "70");
  CHECK(value_of(translated(bounds + "fill_pattern = grid\n"), "speed_infill") == "40");
  CHECK(value_of(translated(speeds + "filament_infill_max_speed = 0\n"), "speed_infill") == "80");
  const auto t = translated(
      "nozzle_diameter = 0.6\nextrusion_width = 0.5\nperimeter_extrusion_width = 0.45\n"
      "support_material_extrusion_width = 0.35\nautomatic_extrusion_widths = 1\n");
  CHECK(value_of(t, "wall_line_width_x") == "0.675");
  CHECK(value_of(t, "support_line_width") == "auto");
}

TEST_CASE("prusaslicer: a draft shield is a skirt of every layer") {
  CHECK(value_of(translated("draft_shield = enabled\nskirt_height = 2\n"), "skirt_height") == "100000");
  CHECK(value_of(translated("draft_shield = limited\nskirt_height = 2\n"), "skirt_height") == "2");
}

TEST_CASE("prusaslicer: what weft does otherwise for a reason is told, with what does it") {
  const auto t = translated(
      "post_process = /usr/bin/upload\nbinary_gcode = 1\nextrusion_axis = A\ntravel_lift_before_obstacle = 1\n"
      "scarf_seam_placement = everywhere\nscarf_seam_entire_loop = 1\nscarf_seam_only_on_smooth = 1\n");
  CHECK(t.unsupported.empty());
  CHECK(t.approximated.size() == 6);
  CHECK_THAT(t.approximated.front().why, Catch::Contains("--exec"));
  CHECK(value_of(t, "scarf_joint_seam_length") == "100");
  CHECK(translated("post_process = \nbinary_gcode = 0\nextrusion_axis = E\nscarf_seam_only_on_smooth = 1\n")
            .approximated.empty());
  CHECK_THROWS_AS(translated("printer_technology = SLA\n"), Error);
}

TEST_CASE("prusaslicer: values that do not parse whole are errors with the line") {
  for (const auto* bad : {"layer_height = 0.2abc", "layer_height = x0,2", "perimeters = three", "wipe = yes",
                          "bed_shape = 0x0;1x1", "fill_pattern = spaghetti"}) {
    INFO(bad);
    try {
      translated(std::string("perimeter_speed = 60\n") + bad + "\n");
      FAIL_CHECK("nothing was thrown");
    } catch (const Error& e) {
      CHECK(e.kind() == Error::Kind::settings);
      CHECK(e.where() == "p.ini:2");
    }
  }
}

TEST_CASE("import: OrcaSlicer's locked zigzag is a density by the distance from the surface") {
  using Words = std::vector<std::pair<std::string, std::string>>;
  const auto densities = [](const Words& words) { return prusaslicer::orca_configuration(words).ours; };
  const auto by_distance = [](const char* text) { return Words{{"infill_density_by_distance", text}}; };
  const std::pair<std::string, std::string> pattern{"sparse_infill_pattern", "lockedzag"},
      skin{"skin_infill_density", "40%"}, skeleton{"skeleton_infill_density", "15%"}, depth{"skin_infill_depth", "1.5"},
      none{"skin_infill_depth", "0"};
  CHECK(densities({skin, pattern, skeleton, depth}) == by_distance("0:40, 1.5:40, 1.5:15"));
  CHECK(densities({pattern}) == by_distance("0:25, 2:25, 2:25"));
  CHECK(densities({pattern, skeleton, none}) == by_distance("0:15"));
  CHECK(densities({{"sparse_infill_pattern", "grid"}, skin}).empty());
}

TEST_CASE("import: OrcaSlicer's holes over counterbores are weft's") {
  using Words = std::vector<std::pair<std::string, std::string>>;
  for (const auto& [theirs, ours] :
       Words{{"none", "none"}, {"partiallybridge", "partial"}, {"sacrificiallayer", "sacrificial"}}) {
    const auto read = prusaslicer::orca_configuration({{"counterbore_hole_bridging", theirs}});
    CHECK(read.left_out.empty());
    CHECK(read.ours == Words{{"counterbore_hole_bridging", ours}});
  }
}

TEST_CASE("import: OrcaSlicer's support is what its names say, and by hand where it is manual") {
  using Words = std::vector<std::pair<std::string, std::string>>;
  const auto read = [](const Words& words) {
    auto out = prusaslicer::orca_configuration(words);
    CHECK(out.left_out.empty());
    return out;
  };
  const auto tree = read({{"support_style", "tree_strong"}, {"support_type", "tree(manual)"}});
  CHECK(tree.ours == Words{{"support_tree_style", "strong"}, {"support_structure", "tree"}, {"support_auto", "false"}});
  const auto normal = read({{"support_style", "snug"}, {"support_type", "normal(auto)"}});
  CHECK(normal.ours ==
        Words{{"support_normal_shape", "snug"}, {"support_structure", "normal"}, {"support_auto", "true"}});
  const auto said = translated(read({{"name", "project_settings"},
                                     {"bridge_no_support", "0"},
                                     {"independent_support_layer_height", "0"},
                                     {"raft_contact_distance", "0.25"},
                                     {"support_base_pattern", "default"},
                                     {"support_bottom_z_distance", "0.3"},
                                     {"support_interface_pattern", "rectilinear_interlaced"},
                                     {"tree_support_branch_angle", "45"},
                                     {"tree_support_branch_angle_organic", "38"}})
                                   .ini);
  CHECK(value_of(said, "support_bridges") == "true");
  CHECK(value_of(said, "support_synchronize_layers") == "true");
  CHECK(value_of(said, "raft_airgap") == "0.25");
  CHECK(value_of(said, "support_pattern") == "zigzag");
  CHECK(value_of(said, "support_bottom_distance") == "0.3");
  CHECK(value_of(said, "support_tree_angle") == "38");
}

TEST_CASE("prusaslicer: anchors of infill are as long as the profile says, and weft's own where it says nothing") {
  const auto said = translated(
      "fill_density = 15%\ninfill_extrusion_width = 0.45\ninfill_anchor = 600%\n"
      "infill_anchor_max = 12\n");
  CHECK(value_of(said, "infill_anchor_length") == "2.7");
  CHECK(value_of(said, "infill_anchor_max") == "12");
  CHECK(value_of(said, "infill_connect_lines") == "true");
  const auto off = translated("fill_density = 15%\ninfill_anchor = 5\ninfill_anchor_max = 0\n");
  CHECK(value_of(off, "infill_anchor_length") == "0");
  CHECK(value_of(off, "infill_connect_lines") == "false");
  const auto silent = translated("fill_density = 15%\n");
  CHECK(value_of(silent, "infill_anchor_length") == "(absent)");
  CHECK(value_of(silent, "infill_anchor_max") == "(absent)");
}
