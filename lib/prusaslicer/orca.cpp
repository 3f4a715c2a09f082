// SPDX-License-Identifier: GPL-3.0-or-later
#include "prusaslicer/orca.h"

#include <algorithm>
#include <array>

namespace weft::prusaslicer {
namespace {

struct OrcaKey {
  std::string_view theirs, prusaslicer;
};
constexpr std::array rows{
    OrcaKey{"wall_loops", "perimeters"},
    OrcaKey{"sparse_infill_density", "fill_density"},
    OrcaKey{"sparse_infill_pattern", "fill_pattern"},
    OrcaKey{"infill_direction", "fill_angle"},
    OrcaKey{"top_shell_layers", "top_solid_layers"},
    OrcaKey{"bottom_shell_layers", "bottom_solid_layers"},
    OrcaKey{"top_shell_thickness", "top_solid_min_thickness"},
    OrcaKey{"bottom_shell_thickness", "bottom_solid_min_thickness"},
    OrcaKey{"top_surface_pattern", "top_fill_pattern"},
    OrcaKey{"bottom_surface_pattern", "bottom_fill_pattern"},
    OrcaKey{"minimum_sparse_infill_area", "solid_infill_below_area"},
    OrcaKey{"infill_combination", "automatic_infill_combination"},
    OrcaKey{"infill_combination_max_layer_height", "automatic_infill_combination_max_layer_height"},
    OrcaKey{"infill_anchor", "infill_anchor"},
    OrcaKey{"infill_anchor_max", "infill_anchor_max"},
    OrcaKey{"is_infill_first", "infill_first"},
    OrcaKey{"infill_wall_overlap", "infill_overlap"},
    OrcaKey{"wall_generator", "perimeter_generator"},
    OrcaKey{"detect_thin_wall", "thin_walls"},
    OrcaKey{"detect_overhang_wall", "overhangs"},
    OrcaKey{"wall_filament", "perimeter_extruder"},
    OrcaKey{"sparse_infill_filament", "infill_extruder"},
    OrcaKey{"solid_infill_filament", "solid_infill_extruder"},
    OrcaKey{"line_width", "extrusion_width"},
    OrcaKey{"outer_wall_line_width", "external_perimeter_extrusion_width"},
    OrcaKey{"inner_wall_line_width", "perimeter_extrusion_width"},
    OrcaKey{"sparse_infill_line_width", "infill_extrusion_width"},
    OrcaKey{"internal_solid_infill_line_width", "solid_infill_extrusion_width"},
    OrcaKey{"top_surface_line_width", "top_infill_extrusion_width"},
    OrcaKey{"initial_layer_line_width", "first_layer_extrusion_width"},
    OrcaKey{"support_line_width", "support_material_extrusion_width"},
    OrcaKey{"outer_wall_speed", "external_perimeter_speed"},
    OrcaKey{"inner_wall_speed", "perimeter_speed"},
    OrcaKey{"sparse_infill_speed", "infill_speed"},
    OrcaKey{"internal_solid_infill_speed", "solid_infill_speed"},
    OrcaKey{"top_surface_speed", "top_solid_infill_speed"},
    OrcaKey{"gap_infill_speed", "gap_fill_speed"},
    OrcaKey{"small_perimeter_speed", "small_perimeter_speed"},
    OrcaKey{"support_speed", "support_material_speed"},
    OrcaKey{"enable_support", "support_material"},
    OrcaKey{"support_on_build_plate_only", "support_material_buildplate_only"},
    OrcaKey{"support_threshold_angle", "support_material_threshold"},
    OrcaKey{"support_top_z_distance", "support_material_contact_distance"},
    OrcaKey{"support_object_xy_distance", "support_material_xy_spacing"},
    OrcaKey{"support_interface_top_layers", "support_material_interface_layers"},
    OrcaKey{"support_base_pattern_spacing", "support_material_spacing"},
    OrcaKey{"enforce_support_layers", "support_material_enforce_layers"},
    OrcaKey{"bridge_no_support", "dont_support_bridges"},
    OrcaKey{"support_angle", "support_material_angle"},
    OrcaKey{"support_base_pattern", "support_material_pattern"},
    OrcaKey{"support_bottom_z_distance", "support_material_bottom_contact_distance"},
    OrcaKey{"support_interface_bottom_layers", "support_material_bottom_interface_layers"},
    OrcaKey{"support_interface_pattern", "support_material_interface_pattern"},
    OrcaKey{"support_interface_spacing", "support_material_interface_spacing"},
    OrcaKey{"support_interface_speed", "support_material_interface_speed"},
    OrcaKey{"support_interface_loop_pattern", "support_material_interface_contact_loops"},
    OrcaKey{"support_filament", "support_material_extruder"},
    OrcaKey{"support_interface_filament", "support_material_interface_extruder"},
    OrcaKey{"independent_support_layer_height", "support_material_synchronize_layers"},
    // Of their two kinds of branches the organic ones are weft's; those come later in a file, and hold.
    OrcaKey{"tree_support_branch_angle", "support_tree_angle"},
    OrcaKey{"tree_support_branch_angle_organic", "support_tree_angle"},
    OrcaKey{"tree_support_branch_diameter", "support_tree_branch_diameter"},
    OrcaKey{"tree_support_branch_diameter_organic", "support_tree_branch_diameter"},
    OrcaKey{"tree_support_branch_diameter_angle", "support_tree_branch_diameter_angle"},
    OrcaKey{"tree_support_tip_diameter", "support_tree_tip_diameter"},
    OrcaKey{"tree_support_top_rate", "support_tree_top_rate"},
    OrcaKey{"tree_support_angle_slow", "support_tree_angle_slow"},
    OrcaKey{"raft_layers", "raft_layers"},
    OrcaKey{"raft_contact_distance", "raft_contact_distance"},
    OrcaKey{"raft_expansion", "raft_expansion"},
    OrcaKey{"raft_first_layer_density", "raft_first_layer_density"},
    OrcaKey{"raft_first_layer_expansion", "raft_first_layer_expansion"},
    OrcaKey{"flush_into_infill", "wipe_into_infill"},
    OrcaKey{"flush_into_objects", "wipe_into_objects"},
    OrcaKey{"xy_contour_compensation", "xy_size_compensation"},
    OrcaKey{"elefant_foot_compensation", "elefant_foot_compensation"},
    OrcaKey{"seam_position", "seam_position"},
    OrcaKey{"layer_height", "layer_height"},
    OrcaKey{"bridge_flow", "bridge_flow_ratio"},
    OrcaKey{"bridge_angle", "bridge_angle"},
    OrcaKey{"fuzzy_skin", "fuzzy_skin"},
    OrcaKey{"fuzzy_skin_thickness", "fuzzy_skin_thickness"},
    OrcaKey{"brim_width", "brim_width"},
    OrcaKey{"brim_type", "brim_type"},
    OrcaKey{"print_sequence", "complete_objects"},
    OrcaKey{"initial_layer_print_height", "first_layer_height"},
    OrcaKey{"initial_layer_speed", "first_layer_speed"},
    OrcaKey{"travel_speed", "travel_speed"},
    OrcaKey{"bridge_speed", "bridge_speed"},
    OrcaKey{"default_acceleration", "default_acceleration"},
    OrcaKey{"outer_wall_acceleration", "external_perimeter_acceleration"},
    OrcaKey{"inner_wall_acceleration", "perimeter_acceleration"},
    OrcaKey{"top_surface_acceleration", "top_solid_infill_acceleration"},
    OrcaKey{"initial_layer_acceleration", "first_layer_acceleration"},
    OrcaKey{"travel_acceleration", "travel_acceleration"},
    OrcaKey{"skirt_loops", "skirts"},
    OrcaKey{"skirt_distance", "skirt_distance"},
    OrcaKey{"skirt_height", "skirt_height"},
    OrcaKey{"spiral_mode", "spiral_vase"},
    OrcaKey{"resolution", "gcode_resolution"},
    OrcaKey{"printable_area", "bed_shape"},
    OrcaKey{"printable_height", "max_print_height"},
    OrcaKey{"nozzle_diameter", "nozzle_diameter"},
    OrcaKey{"gcode_flavor", "gcode_flavor"},
    OrcaKey{"machine_start_gcode", "start_gcode"},
    OrcaKey{"machine_end_gcode", "end_gcode"},
    OrcaKey{"extruder_clearance_radius", "extruder_clearance_radius"},
    OrcaKey{"extruder_clearance_height_to_rod", "extruder_clearance_height"},
    OrcaKey{"retraction_length", "retract_length"},
    OrcaKey{"retraction_speed", "retract_speed"},
    OrcaKey{"deretraction_speed", "deretract_speed"},
    OrcaKey{"z_hop", "retract_lift"},
    OrcaKey{"wipe", "wipe"},
    OrcaKey{"filament_diameter", "filament_diameter"},
    OrcaKey{"filament_density", "filament_density"},
    OrcaKey{"filament_cost", "filament_cost"},
    OrcaKey{"filament_type", "filament_type"},
    OrcaKey{"filament_colour", "filament_colour"},
    OrcaKey{"filament_flow_ratio", "extrusion_multiplier"},
    OrcaKey{"filament_max_volumetric_speed", "filament_max_volumetric_speed"},
    OrcaKey{"nozzle_temperature", "temperature"},
    OrcaKey{"nozzle_temperature_initial_layer", "first_layer_temperature"},
    OrcaKey{"hot_plate_temp", "bed_temperature"},
    OrcaKey{"hot_plate_temp_initial_layer", "first_layer_bed_temperature"},
    OrcaKey{"fan_min_speed", "min_fan_speed"},
    OrcaKey{"fan_max_speed", "max_fan_speed"},
    OrcaKey{"overhang_fan_speed", "bridge_fan_speed"},
    OrcaKey{"fan_cooling_layer_time", "fan_below_layer_time"},
    OrcaKey{"slow_down_layer_time", "slowdown_below_layer_time"},
    OrcaKey{"slow_down_min_speed", "min_print_speed"},
    OrcaKey{"close_fan_the_first_x_layers", "disable_fan_first_layers"},
    OrcaKey{"enable_prime_tower", "wipe_tower"},
    OrcaKey{"prime_tower_width", "wipe_tower_width"},
    OrcaKey{"prime_tower_brim_width", "wipe_tower_brim_width"},
    OrcaKey{"wipe_tower_x", "wipe_tower_x"},
    OrcaKey{"wipe_tower_y", "wipe_tower_y"},
    OrcaKey{"wipe_tower_rotation_angle", "wipe_tower_rotation_angle"},
    OrcaKey{"wipe_tower_bridging", "wipe_tower_bridging"},
    OrcaKey{"wipe_tower_cone_angle", "wipe_tower_cone_angle"},
    OrcaKey{"wipe_tower_extra_flow", "wipe_tower_extra_flow"},
    OrcaKey{"wipe_tower_extra_spacing", "wipe_tower_extra_spacing"},
    OrcaKey{"ironing_type", "ironing_type"},
    OrcaKey{"ironing_flow", "ironing_flowrate"},
    OrcaKey{"ironing_spacing", "ironing_spacing"},
    OrcaKey{"ironing_speed", "ironing_speed"},
};

/// What weft has and PrusaSlicer has not.
struct OwnKey {
  std::string_view theirs, ours;
};
constexpr std::array own_rows{
    OwnKey{"xy_hole_compensation", "hole_xy_offset"},
    OwnKey{"max_bridge_length", "support_max_bridge_length"},
    OwnKey{"brim_object_gap", "brim_gap"},
    OwnKey{"brim_ears_max_angle", "brim_ears_max_angle"},
    OwnKey{"interlocking_beam", "interlocking_enable"},
    OwnKey{"interlocking_beam_width", "interlocking_beam_width"},
    OwnKey{"interlocking_orientation", "interlocking_orientation"},
    OwnKey{"interlocking_beam_layer_count", "interlocking_beam_layer_count"},
    OwnKey{"interlocking_depth", "interlocking_depth"},
    OwnKey{"interlocking_boundary_avoidance", "interlocking_boundary_avoidance"},
};

/// Values that are settings of weft's, a row for each.
struct OwnValue {
  std::string_view theirs, value, ours, text;
};
constexpr std::array own_values{
    OwnValue{"brim_type", "brim_ears", "brim_ears", "on"},
    OwnValue{"brim_type", "auto_brim", "brim_narrow_width", "8"},
    OwnValue{"counterbore_hole_bridging", "none", "counterbore_hole_bridging", "none"},
    OwnValue{"counterbore_hole_bridging", "partiallybridge", "counterbore_hole_bridging", "partial"},
    OwnValue{"counterbore_hole_bridging", "sacrificiallayer", "counterbore_hole_bridging", "sacrificial"},
    // manual: what is painted or marked, and nothing else
    OwnValue{"support_type", "normal(auto)", "support_structure", "normal"},
    OwnValue{"support_type", "normal(auto)", "support_auto", "true"},
    OwnValue{"support_type", "normal(manual)", "support_structure", "normal"},
    OwnValue{"support_type", "normal(manual)", "support_auto", "false"},
    OwnValue{"support_type", "tree(auto)", "support_structure", "tree"},
    OwnValue{"support_type", "tree(auto)", "support_auto", "true"},
    OwnValue{"support_type", "tree(manual)", "support_structure", "tree"},
    OwnValue{"support_type", "tree(manual)", "support_auto", "false"},
    OwnValue{"support_type", "hybrid(auto)", "support_structure", "hybrid"},
    OwnValue{"support_type", "hybrid(auto)", "support_auto", "true"},
    OwnValue{"support_style", "default", "support_normal_shape", "grid"},
    OwnValue{"support_style", "grid", "support_normal_shape", "grid"},
    OwnValue{"support_style", "snug", "support_normal_shape", "snug"},
    OwnValue{"support_style", "organic", "support_tree_style", "organic"},
    OwnValue{"support_style", "tree_slim", "support_tree_style", "slim"},
    OwnValue{"support_style", "tree_strong", "support_tree_style", "strong"},
    // columns under what is large and flat: weft's branches carry a roof there
    OwnValue{"support_style", "tree_hybrid", "support_tree_style", "organic"},
};

/// Values that are called otherwise; everything else is called the same.
struct OrcaValue {
  std::string_view prusaslicer, theirs, value;
};
constexpr std::array values{
    OrcaValue{"fill_pattern", "zig-zag", "rectilinear"},
    OrcaValue{"fill_pattern", "tri-hexagon", "stars"},
    OrcaValue{"top_fill_pattern", "monotonicline", "monotoniclines"},
    OrcaValue{"bottom_fill_pattern", "monotonicline", "monotoniclines"},
    OrcaValue{"top_fill_pattern", "zig-zag", "rectilinear"},
    OrcaValue{"bottom_fill_pattern", "zig-zag", "rectilinear"},
    OrcaValue{"seam_position", "back", "rear"},
    OrcaValue{"complete_objects", "by object", "1"},
    OrcaValue{"complete_objects", "by layer", "0"},
    OrcaValue{"complete_objects", "as_obj_list", "0"},
    OrcaValue{"support_material_pattern", "default", "rectilinear"},
    OrcaValue{"support_material_pattern", "lightning", "rectilinear"},
    OrcaValue{"support_material_pattern", "hollow", "rectilinear"},
    OrcaValue{"support_material_interface_pattern", "rectilinear_interlaced", "rectilinear"},
    OrcaValue{"support_material_interface_pattern", "grid", "rectilinear"},
    OrcaValue{"support_material_synchronize_layers", "0", "1"},  // it says the opposite
    OrcaValue{"support_material_synchronize_layers", "1", "0"},
};

}  // namespace

std::optional<std::pair<std::string, std::string>> from_orca(std::string_view key, std::string_view value) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const OrcaKey& r) { return r.theirs == key; });
  if (row == rows.end()) return std::nullopt;
  const auto named = std::find_if(values.begin(), values.end(), [&](const OrcaValue& v) {
    return v.prusaslicer == row->prusaslicer && v.theirs == value;
  });
  return std::pair(std::string(row->prusaslicer), std::string(named == values.end() ? value : named->value));
}

std::vector<std::pair<std::string, std::string>> ours_of_orca(std::string_view key, std::string_view value) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const auto& row : own_values)
    if (row.theirs == key && row.value == value) out.emplace_back(row.ours, row.text);
  const auto row = std::find_if(own_rows.begin(), own_rows.end(), [&](const OwnKey& r) { return r.theirs == key; });
  if (row == own_rows.end()) return out;
  const bool flag = row->ours.ends_with("_enable");
  out.emplace_back(row->ours, !flag ? value : value == "1" ? "true" : "false");
  return out;
}

namespace {

/// What their pattern lockedzag lays in its skin and in what is deeper: a density by the distance from the surface.
struct Locked {
  std::string skin = "25", skeleton = "25", depth = "2";  // their usual ones; %, %, mm
  bool on = false;

  /// @returns whether the key is one of its own
  bool take(std::string_view key, std::string value) {
    if (key == "sparse_infill_pattern") on = value == "lockedzag";
    if (value.ends_with('%')) value.pop_back();
    const std::array own{std::pair("skin_infill_density", &skin), std::pair("skeleton_infill_density", &skeleton),
                         std::pair("skin_infill_depth", &depth)};
    const auto* found = std::find_if(own.begin(), own.end(), [&](const auto& each) { return key == each.first; });
    if (found == own.end()) return false;
    *found->second = std::move(value);
    return true;
  }
  std::string by_distance() const {
    if (depth == "0") return "0:" + skeleton;
    return "0:" + skin + ", " + depth + ":" + skin + ", " + depth + ":" + skeleton;
  }
};

}  // namespace

namespace {

/// What a configuration is called and where it comes from: nothing of it is a setting.
constexpr std::array of_the_making{std::string_view("name"),
                                   std::string_view("from"),
                                   std::string_view("version"),
                                   std::string_view("inherits"),
                                   std::string_view("inherits_group"),
                                   std::string_view("is_custom_defined"),
                                   std::string_view("different_settings_to_system"),
                                   std::string_view("print_settings_id"),
                                   std::string_view("filament_settings_id"),
                                   std::string_view("printer_settings_id"),
                                   std::string_view("filament_ids"),
                                   std::string_view("printer_model"),
                                   std::string_view("printer_variant")};

}  // namespace

OrcaConfiguration orca_configuration(const std::vector<std::pair<std::string, std::string>>& all) {
  OrcaConfiguration out;
  Locked locked;
  out.ini = "# generated by PrusaSlicer\n";
  for (const auto& [key, value] : all) {
    if (value.empty() || value == "nil") continue;
    if (std::find(of_the_making.begin(), of_the_making.end(), key) != of_the_making.end()) continue;
    if (locked.take(key, value)) continue;
    if (const auto ours = ours_of_orca(key, value); !ours.empty()) {
      out.ours.insert(out.ours.end(), ours.begin(), ours.end());
      continue;
    }
    const auto theirs = from_orca(key, value);
    if (theirs)
      out.ini += theirs->first + " = " + theirs->second + "\n";
    else
      out.left_out.push_back(key);
  }
  if (locked.on) out.ours.emplace_back("infill_density_by_distance", locked.by_distance());
  return out;
}

}  // namespace weft::prusaslicer
