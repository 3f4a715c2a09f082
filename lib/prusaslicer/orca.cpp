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
    OrcaKey{"raft_layers", "raft_layers"},
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

}  // namespace weft::prusaslicer
