// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/schema.h"

#include <array>

namespace weft {
using namespace weft::literals;

/// How support stands: columns straight down, branches that meet on the way down, or of each patch what takes less.
enum class SupportStructure { normal, tree, hybrid };
constexpr auto choices_of(SupportStructure) {
  return std::array{Choice<SupportStructure>{SupportStructure::normal, "normal"},
                    Choice<SupportStructure>{SupportStructure::tree, "tree"},
                    Choice<SupportStructure>{SupportStructure::hybrid, "hybrid"}};
}

/// The cross-section of columns: on a coarse grid, stiff and easy to take off, or as the overhang is.
enum class SupportShape { grid, snug };
constexpr auto choices_of(SupportShape) {
  return std::array{Choice<SupportShape>{SupportShape::grid, "grid"}, Choice<SupportShape>{SupportShape::snug, "snug"}};
}

/// What support may stand on.
enum class SupportType { everywhere, buildplate };
constexpr auto choices_of(SupportType) {
  return std::array{Choice<SupportType>{SupportType::everywhere, "everywhere"},
                    Choice<SupportType>{SupportType::buildplate, "buildplate"}};
}

/// How the inside of support is laid out. zigzag: lines that are joined at their ends.
enum class SupportPattern { lines, zigzag, grid, triangles, concentric, gyroid };
constexpr auto choices_of(SupportPattern) {
  return std::array{Choice<SupportPattern>{SupportPattern::lines, "lines"},
                    Choice<SupportPattern>{SupportPattern::zigzag, "zigzag"},
                    Choice<SupportPattern>{SupportPattern::grid, "grid"},
                    Choice<SupportPattern>{SupportPattern::triangles, "triangles"},
                    Choice<SupportPattern>{SupportPattern::concentric, "concentric"},
                    Choice<SupportPattern>{SupportPattern::gyroid, "gyroid"}};
}

/// How thick branches are where nothing else is said. slim: off again most easily; strong: for heavy parts.
enum class SupportTreeStyle { organic, slim, strong };
constexpr auto choices_of(SupportTreeStyle) {
  return std::array{Choice<SupportTreeStyle>{SupportTreeStyle::organic, "organic"},
                    Choice<SupportTreeStyle>{SupportTreeStyle::slim, "slim"},
                    Choice<SupportTreeStyle>{SupportTreeStyle::strong, "strong"}};
}

/// What happens to support that would leave the print surface or enter a no-go area.
enum class SupportOutside { keep, route };
constexpr auto choices_of(SupportOutside) {
  return std::array{Choice<SupportOutside>{SupportOutside::keep, "keep"},
                    Choice<SupportOutside>{SupportOutside::route, "route"}};
}

/// What stands under overhangs while they are printed.
struct SupportSettings {
  bool support_enable = false;
  bool support_auto = true;
  SupportStructure support_structure = SupportStructure::hybrid;
  SupportShape support_normal_shape = SupportShape::snug;
  SupportType support_type = SupportType::everywhere;
  std::optional<double> support_angle = 50;
  bool support_bridges = false;
  Um support_max_bridge_length = 20_mm;
  Um support_cantilever_length = 3_mm;
  double minimum_support_area = 1;
  int support_enforce_layers = 0;
  Um support_z_distance = 0.2_mm;
  std::optional<Um> support_top_distance;
  std::optional<Um> support_bottom_distance;
  LengthOrShare support_xy_distance = length(0.7_mm);
  Um support_xy_distance_overhang = 0.2_mm;
  bool support_xy_overrides_z = false;
  Um support_bottom_stair_step_height = 0_mm;
  Um support_bottom_stair_step_width = 5_mm;
  bool support_synchronize_layers = false;
  std::optional<Um> support_infill_sparse_thickness;
  std::optional<LengthOrShare> support_line_width;
  std::optional<int> support_wall_count;
  SupportPattern support_pattern = SupportPattern::zigzag;
  double support_infill_rate = 15;
  double support_infill_angle = 0;
  int gradual_support_infill_steps = 1;
  Um gradual_support_infill_step_height = 1.5_mm;
  Um support_join_distance = 2_mm;
  double support_initial_layer_density = 90;
  Um support_brim_width = 3_mm;
  bool support_roof_enable = true;
  bool support_bottom_enable = false;
  Um support_roof_height = 0.6_mm;
  std::optional<Um> support_bottom_height;
  double support_interface_density = 100;
  SupportPattern support_interface_pattern = SupportPattern::zigzag;
  int support_roof_wall_count = 0;
  std::optional<int> support_infill_extruder_nr;
  std::optional<int> support_interface_extruder_nr;
  bool support_conical_enabled = false;
  double support_conical_angle = 30;
  Um support_conical_min_width = 5_mm;
  bool support_use_towers = false;
  Um support_tower_diameter = 3_mm;
  Um support_tower_maximum_supported_diameter = 3_mm;
  double support_tower_roof_angle = 65;
  SupportTreeStyle support_tree_style = SupportTreeStyle::organic;
  double support_tree_angle = 40;
  std::optional<double> support_tree_angle_slow;
  std::optional<Um> support_tree_branch_diameter;
  std::optional<double> support_tree_branch_diameter_angle;
  Um support_tree_branch_diameter_double_wall = 10_mm;
  std::optional<Um> support_tree_tip_diameter;
  Um support_tree_branch_distance = 1_mm;
  double support_tree_top_rate = 15;
  double support_tree_infill_rate = 0;
  Um support_tree_max_diameter = 25_mm;
  Um support_tree_bp_diameter = 7.5_mm;
  bool support_blockers_avoided = false;
  SupportOutside support_outside = SupportOutside::route;
};

inline constexpr Rows support_schema{
    setting("support_enable", Scope::object, &SupportSettings::support_enable,
            "Support is printed under what overhangs."),
    setting("support_auto", Scope::object, &SupportSettings::support_auto,
            "Overhangs are found; off: only what enforcers mark is supported."),
    setting("support_structure", Scope::object, &SupportSettings::support_structure,
            "normal: columns straight down; tree: branches; hybrid: of each patch what takes less plastic."),
    setting("support_normal_shape", Scope::object, &SupportSettings::support_normal_shape,
            "Cross-section of columns: on a coarse grid, or as the overhang is."),
    setting("support_type", Scope::object, &SupportSettings::support_type,
            "What support may stand on: the plate alone, or the part as well."),
    setting("support_angle", Scope::object, &SupportSettings::support_angle, Unit::degrees, 0, 89,
            "Faces that lean out further than this, against the vertical, are supported; auto: what reaches further "
            "than half an outer line beyond the layer below."),
    setting("support_bridges", Scope::object, &SupportSettings::support_bridges,
            "Bridges are supported too; off: what strands can cross between two rests is left out."),
    setting("support_max_bridge_length", Scope::object, &SupportSettings::support_max_bridge_length, Unit::mm, 0_mm,
            200_mm, "Longest bridge that is left unsupported."),
    setting("support_cantilever_length", Scope::object, &SupportSettings::support_cantilever_length, Unit::mm, 0_mm,
            100_mm, "What reaches further than this into the air is supported, however small its area is."),
    setting("minimum_support_area", Scope::object, &SupportSettings::minimum_support_area, Unit::mm2, 0, 10000,
            "Smaller overhangs get no support, unless nothing lies below them."),
    setting("support_enforce_layers", Scope::object, &SupportSettings::support_enforce_layers, Unit::layers, 0, 1000000,
            "First layers under which every overhang is supported, also when support_enable is off."),
    setting("support_z_distance", Scope::object, &SupportSettings::support_z_distance, Unit::mm, 0_mm, 10_mm,
            "Gap between support and the part above and below it."),
    setting("support_top_distance", Scope::object, &SupportSettings::support_top_distance, Unit::mm, 0_mm, 10_mm,
            "Gap between support and the part above it; auto is support_z_distance."),
    setting("support_bottom_distance", Scope::object, &SupportSettings::support_bottom_distance, Unit::mm, 0_mm, 10_mm,
            "Least gap between support and the part it stands on; auto is support_z_distance."),
    setting("support_xy_distance", Scope::object, &SupportSettings::support_xy_distance, Unit::mm, 0_mm, 20_mm,
            "Gap between support and the part beside it; a share is of wall_line_width_0."),
    setting("support_xy_distance_overhang", Scope::object, &SupportSettings::support_xy_distance_overhang, Unit::mm,
            0_mm, 20_mm, "The same beside what is supported, where support_xy_overrides_z is off."),
    setting("support_xy_overrides_z", Scope::object, &SupportSettings::support_xy_overrides_z,
            "support_xy_distance holds beside overhangs as well, although support then ends further below them."),
    setting("support_bottom_stair_step_height", Scope::object, &SupportSettings::support_bottom_stair_step_height,
            Unit::mm, 0_mm, 10_mm,
            "Support that stands on a slope of the part begins in steps of this height, so that it comes off; 0: as "
            "near everywhere as support_bottom_distance allows."),
    setting("support_bottom_stair_step_width", Scope::object, &SupportSettings::support_bottom_stair_step_width,
            Unit::mm, 0_mm, 100_mm, "No step of support_bottom_stair_step_height is wider than this."),
    setting("support_synchronize_layers", Scope::object, &SupportSettings::support_synchronize_layers,
            "Support is printed in the part's layers; the gap above it is rounded up to whole ones."),
    setting("support_infill_sparse_thickness", Scope::object, &SupportSettings::support_infill_sparse_thickness,
            Unit::mm, 0.02_mm, 5_mm,
            "Height of support's layers where nothing that it holds asks for others; auto is three quarters of "
            "nozzle_diameter."),
    setting("support_line_width", Scope::object, &SupportSettings::support_line_width, Unit::mm, 0.05_mm, 10_mm,
            "Line width of support; auto is nozzle_diameter; a share is of nozzle_diameter."),
    setting("support_wall_count", Scope::object, &SupportSettings::support_wall_count, Unit::none, 0, 20,
            "Loops around support; auto: one around branches, none around columns."),
    setting("support_pattern", Scope::object, &SupportSettings::support_pattern, "Layout of the inside of support."),
    setting("support_infill_rate", Scope::object, &SupportSettings::support_infill_rate, Unit::percent, 0, 100,
            "Share of the inside of columns that is plastic."),
    setting("support_infill_angle", Scope::object, &SupportSettings::support_infill_angle, Unit::degrees, -360, 360,
            "Direction of the lines of support, against X; what a roof lies on lies across, as do floors."),
    setting("gradual_support_infill_steps", Scope::object, &SupportSettings::gradual_support_infill_steps, Unit::none,
            0, 10,
            "How often columns of lines, zigzag, grid or triangles get half as dense on the way down from what they "
            "carry, as far as what is laid above crosses from line to line; lines and zigzag turn across each time."),
    setting("gradual_support_infill_step_height", Scope::object, &SupportSettings::gradual_support_infill_step_height,
            Unit::mm, 0.1_mm, 1000_mm, "Height of one step of gradual_support_infill_steps, the first below the roof."),
    setting("support_join_distance", Scope::object, &SupportSettings::support_join_distance, Unit::mm, 0_mm, 50_mm,
            "Columns nearer to each other than this become one."),
    setting(
        "support_initial_layer_density", Scope::object, &SupportSettings::support_initial_layer_density, Unit::percent,
        10, 100,
        "Share of support's first layer that is plastic, so that it sticks. From 50 % on what is too narrow for its "
        "lines is loops beside each other."),
    setting("support_brim_width", Scope::object, &SupportSettings::support_brim_width, Unit::mm, 0_mm, 50_mm,
            "How far the first layer of support reaches beyond it."),
    setting("support_roof_enable", Scope::object, &SupportSettings::support_roof_enable,
            "The top of support is a dense interface."),
    setting(
        "support_bottom_enable", Scope::object, &SupportSettings::support_bottom_enable,
        "Where support stands on the part it begins with a dense interface; else wide columns stand there on pieces of "
        "their lowest beads."),
    setting("support_roof_height", Scope::object, &SupportSettings::support_roof_height, Unit::mm, 0_mm, 10_mm,
            "Height of the interface on top, in whole layers; the lowest of it is strands that carry the rest."),
    setting("support_bottom_height", Scope::object, &SupportSettings::support_bottom_height, Unit::mm, 0_mm, 10_mm,
            "Height of the interface at the bottom, in whole layers; auto is support_roof_height."),
    setting("support_interface_density", Scope::object, &SupportSettings::support_interface_density, Unit::percent, 1,
            100, "Share of interfaces that is plastic."),
    setting("support_interface_pattern", Scope::object, &SupportSettings::support_interface_pattern,
            "Layout of interfaces that are not dense, and of dense ones zigzag (joined at the ends) or lines."),
    setting("support_roof_wall_count", Scope::object, &SupportSettings::support_roof_wall_count, Unit::none, 0, 20,
            "Loops around interfaces."),
    setting("support_infill_extruder_nr", Scope::object, &SupportSettings::support_infill_extruder_nr, Unit::none, 0,
            31, "Tool that prints columns and branches; auto: whichever is loaded."),
    setting("support_interface_extruder_nr", Scope::object, &SupportSettings::support_interface_extruder_nr, Unit::none,
            0, 31, "Tool that prints interfaces; auto: whichever is loaded."),
    setting(
        "support_conical_enabled", Scope::object, &SupportSettings::support_conical_enabled,
        "Columns get narrower downwards, by support_conical_angle, what lines fill only along them: less plastic, and "
        "less that holds on to the bed."),
    setting("support_conical_angle", Scope::object, &SupportSettings::support_conical_angle, Unit::degrees, -85, 85,
            "How far the faces of conical columns lean inwards on the way down; below 0 they get wider."),
    setting("support_conical_min_width", Scope::object, &SupportSettings::support_conical_min_width, Unit::mm, 0_mm,
            200_mm, "Conical columns get no narrower, nor narrower than an eighth of their height."),
    setting("support_use_towers", Scope::object, &SupportSettings::support_use_towers,
            "Tiny overhangs stand on round towers, which are thicker than they are."),
    setting("support_tower_diameter", Scope::object, &SupportSettings::support_tower_diameter, Unit::mm, 0.1_mm, 50_mm,
            "Diameter of towers."),
    setting("support_tower_maximum_supported_diameter", Scope::object,
            &SupportSettings::support_tower_maximum_supported_diameter, Unit::mm, 0_mm, 50_mm,
            "Overhangs no wider than this in X and Y stand on towers."),
    setting("support_tower_roof_angle", Scope::object, &SupportSettings::support_tower_roof_angle, Unit::degrees, 0, 85,
            "How steep the top of a tower is, against the horizontal: 0 is flat."),
    setting("support_tree_style", Scope::object, &SupportSettings::support_tree_style,
            "What is taken for diameters of branches that are auto: thin ones come off more easily, thick ones stand "
            "firmer."),
    setting("support_tree_angle", Scope::object, &SupportSettings::support_tree_angle, Unit::degrees, 1, 85,
            "How far branches may lean, against the vertical."),
    setting("support_tree_angle_slow", Scope::object, &SupportSettings::support_tree_angle_slow, Unit::degrees, 1, 85,
            "How far branches lean where nothing is in their way; auto is support_tree_angle. No more than that."),
    setting("support_tree_branch_diameter", Scope::object, &SupportSettings::support_tree_branch_diameter, Unit::mm,
            0.1_mm, 50_mm, "Diameter of a branch that has left its tip behind; auto: 2 mm, slim 1.2, strong 4."),
    setting("support_tree_branch_diameter_angle", Scope::object, &SupportSettings::support_tree_branch_diameter_angle,
            Unit::degrees, 0, 30, "How fast branches get thicker downwards; auto: 5°, slim 3, strong 7."),
    setting("support_tree_branch_diameter_double_wall", Scope::object,
            &SupportSettings::support_tree_branch_diameter_double_wall, Unit::mm, 0_mm, 200_mm,
            "Branches thicker than this have two walls; 0: none have."),
    setting("support_tree_tip_diameter", Scope::object, &SupportSettings::support_tree_tip_diameter, Unit::mm, 0.1_mm,
            50_mm,
            "Diameter of a branch where it begins; auto: 0.8 mm, slim 0.6, strong 1. No more than "
            "support_tree_branch_diameter."),
    setting("support_tree_branch_distance", Scope::object, &SupportSettings::support_tree_branch_distance, Unit::mm,
            0.1_mm, 50_mm, "No place of what is supported lies further than this from the tip of a branch."),
    setting("support_tree_top_rate", Scope::object, &SupportSettings::support_tree_top_rate, Unit::percent, 1, 100,
            "Share of what is supported that tips touch, where support_tree_branch_distance would set them denser."),
    setting("support_tree_infill_rate", Scope::object, &SupportSettings::support_tree_infill_rate, Unit::percent, 0,
            100, "Share of the inside of branches that is plastic; 0: they are hollow."),
    setting("support_tree_max_diameter", Scope::object, &SupportSettings::support_tree_max_diameter, Unit::mm, 0.1_mm,
            200_mm, "Branches get no thicker."),
    setting("support_tree_bp_diameter", Scope::object, &SupportSettings::support_tree_bp_diameter, Unit::mm, 0_mm,
            200_mm, "Least diameter of a trunk where it stands on the plate."),
    setting("support_blockers_avoided", Scope::object, &SupportSettings::support_blockers_avoided,
            "No support goes through what blockers mark; off: they only forbid contacts."),
    setting(
        "support_outside", Scope::object, &SupportSettings::support_outside,
        "Support that would leave the print surface or enter a no-go area: keep leaves it to the audit, route keeps "
        "it inside."),
};
static_assert(complete<SupportSettings>(support_schema));

}  // namespace weft
