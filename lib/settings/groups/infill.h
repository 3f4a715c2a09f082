// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/schema.h"

#include <array>

namespace weft {
using namespace weft::literals;

/// How sparse infill is laid out; infill/pattern.cpp has a row for each.
enum class InfillPattern {
  lines,
  grid,
  triangles,
  gyroid,
  concentric,
  zigzag,
  aligned,
  slanted,
  crosszag,
  trihexagon,
  cubic,
  tetrahedral,
  quarter_cubic,
  cubicsubdiv,
  support_cubic,
  honeycomb,
  octagon,
  honeycomb_3d,
  crosshatch,
  lateral_lattice,
  lateral_honeycomb,
  diamond,
  fischer_koch,
  schwarz_p,
  hilbert,
  peano,
  archimedean,
  octagram,
  fermat,
  voronoi,
  voronoi_3d,
  cross,
  cross_3d,
  lightning,
  lockedzag,
  medial,
  streamlines,
};
constexpr auto choices_of(InfillPattern) {
  using enum InfillPattern;
  return std::array{
      Choice<InfillPattern>{lines, "lines"},
      Choice<InfillPattern>{grid, "grid"},
      Choice<InfillPattern>{triangles, "triangles"},
      Choice<InfillPattern>{gyroid, "gyroid"},
      Choice<InfillPattern>{concentric, "concentric"},
      Choice<InfillPattern>{zigzag, "zigzag"},
      Choice<InfillPattern>{aligned, "aligned"},
      Choice<InfillPattern>{slanted, "slanted"},
      Choice<InfillPattern>{crosszag, "crosszag"},
      Choice<InfillPattern>{trihexagon, "trihexagon"},
      Choice<InfillPattern>{cubic, "cubic"},
      Choice<InfillPattern>{tetrahedral, "tetrahedral"},
      Choice<InfillPattern>{quarter_cubic, "quarter_cubic"},
      Choice<InfillPattern>{cubicsubdiv, "cubicsubdiv"},
      Choice<InfillPattern>{support_cubic, "support_cubic"},
      Choice<InfillPattern>{honeycomb, "honeycomb"},
      Choice<InfillPattern>{octagon, "octagon"},
      Choice<InfillPattern>{honeycomb_3d, "honeycomb_3d"},
      Choice<InfillPattern>{crosshatch, "crosshatch"},
      Choice<InfillPattern>{lateral_lattice, "lateral_lattice"},
      Choice<InfillPattern>{lateral_honeycomb, "lateral_honeycomb"},
      Choice<InfillPattern>{diamond, "diamond"},
      Choice<InfillPattern>{fischer_koch, "fischer_koch"},
      Choice<InfillPattern>{schwarz_p, "schwarz_p"},
      Choice<InfillPattern>{hilbert, "hilbert"},
      Choice<InfillPattern>{peano, "peano"},
      Choice<InfillPattern>{archimedean, "archimedean"},
      Choice<InfillPattern>{octagram, "octagram"},
      Choice<InfillPattern>{fermat, "fermat"},
      Choice<InfillPattern>{voronoi, "voronoi"},
      Choice<InfillPattern>{voronoi_3d, "voronoi_3d"},
      Choice<InfillPattern>{cross, "cross"},
      Choice<InfillPattern>{cross_3d, "cross_3d"},
      Choice<InfillPattern>{lightning, "lightning"},
      Choice<InfillPattern>{lockedzag, "lockedzag"},
      Choice<InfillPattern>{medial, "medial"},
      Choice<InfillPattern>{streamlines, "streamlines"},
  };
}

/// Which densities win where several are asked for.
enum class DensityCombine { max, min, multiply };
constexpr auto choices_of(DensityCombine) {
  using enum DensityCombine;
  return std::array{Choice<DensityCombine>{max, "max"}, Choice<DensityCombine>{min, "min"},
                    Choice<DensityCombine>{multiply, "multiply"}};
}

/// What the numbers of a file of densities mean.
enum class DensityUnit { fraction, percent };
constexpr auto choices_of(DensityUnit) {
  return std::array{Choice<DensityUnit>{DensityUnit::fraction, "fraction"},
                    Choice<DensityUnit>{DensityUnit::percent, "percent"}};
}

/// What lines of two directions do where they meet.
enum class InfillCrossings { cross, bend };
constexpr auto choices_of(InfillCrossings) {
  return std::array{Choice<InfillCrossings>{InfillCrossings::cross, "cross"},
                    Choice<InfillCrossings>{InfillCrossings::bend, "bend"}};
}

/// What patterns stand still against.
enum class InfillFrame { part, plate };
constexpr auto choices_of(InfillFrame) {
  return std::array{Choice<InfillFrame>{InfillFrame::part, "part"}, Choice<InfillFrame>{InfillFrame::plate, "plate"}};
}

/// How a density between two that a pattern can have is made of both.
enum class DensityDither { none, floyd_steinberg, blue_noise };
constexpr auto choices_of(DensityDither) {
  using enum DensityDither;
  return std::array{Choice<DensityDither>{none, "none"}, Choice<DensityDither>{floyd_steinberg, "floyd_steinberg"},
                    Choice<DensityDither>{blue_noise, "blue_noise"}};
}

/// What stands inside the part between its shells.
struct InfillSettings {
  double infill_sparse_density = 20;
  InfillPattern infill_pattern = InfillPattern::grid;
  std::optional<LengthOrShare> infill_line_width;
  double infill_angle = 45;
  Numbers infill_angles;
  Um infill_offset_x = 0;
  Um infill_offset_y = 0;
  InfillFrame infill_angle_frame = InfillFrame::plate;
  InfillFrame infill_phase_frame = InfillFrame::part;
  InfillCrossings infill_crossings = InfillCrossings::cross;
  LengthOrShare infill_overlap = share(15);
  bool infill_connect_lines = true;
  std::optional<Um> infill_anchor_max;
  Um infill_anchor_length = 0;
  int infill_wall_line_count = 0;
  int infill_multiplier = 1;
  std::optional<Um> infill_sparse_thickness;
  bool infill_support_enabled = false;
  double infill_support_angle = 40;
  double lightning_infill_support_angle = 45;
  std::optional<double> lightning_infill_overhang_angle;
  std::optional<double> lightning_infill_prune_angle;
  std::optional<double> lightning_infill_straightening_angle;
  std::string infill_pattern_by_density;
  std::string infill_direction_field;
  ValuesAt infill_density_by_distance;
  ValuesAt infill_density_by_height;
  int gradual_infill_steps = 0;
  Um gradual_infill_step_height = 1.5_mm;
  std::string infill_density_image;
  Ring infill_density_image_box;
  std::string infill_density_field;
  DensityUnit infill_density_field_unit = DensityUnit::fraction;
  TransferCurve infill_density_transfer;
  DensityDither infill_density_dither = DensityDither::none;
  DensityCombine infill_density_combine = DensityCombine::max;
  std::string infill_modifiers;
  double infill_density_min = 5;
  double infill_density_max = 90;
};

/// Settings that name a file: its path is relative to the profile that says it.
inline constexpr std::array infill_files{std::string_view("infill_density_image"),
                                         std::string_view("infill_density_field"),
                                         std::string_view("infill_direction_field")};

inline constexpr Rows infill_schema{
    setting("infill_sparse_density", Scope::region, &InfillSettings::infill_sparse_density, Unit::percent, 0, 100,
            "Share of the inside that is plastic; 100 % is solid."),
    setting("infill_pattern", Scope::region, &InfillSettings::infill_pattern, "Layout of sparse infill."),
    setting("infill_line_width", Scope::region, &InfillSettings::infill_line_width, Unit::mm, 0.05_mm, 10_mm,
            "Line width of sparse infill; auto keeps the cross-section of the nozzle; a share is of nozzle_diameter."),
    setting("infill_angle", Scope::region, &InfillSettings::infill_angle, Unit::degrees, -360, 360,
            "Direction of sparse lines, against X; the pattern lines is turned by 90° on every second layer."),
    setting("infill_angles", Scope::region, &InfillSettings::infill_angles, Unit::degrees, -360, 360,
            "Directions of sparse lines, against X, a layer each, again from the first after the last: 0, 60, 120. "
            "Empty: infill_angle, as the pattern turns it."),
    setting("infill_offset_x", Scope::region, &InfillSettings::infill_offset_x, Unit::mm, -1000_mm, 1000_mm,
            "How far the pattern is moved along X from the middle of the object."),
    setting("infill_offset_y", Scope::region, &InfillSettings::infill_offset_y, Unit::mm, -1000_mm, 1000_mm,
            "How far the pattern is moved along Y from the middle of the object."),
    setting("infill_angle_frame", Scope::object, &InfillSettings::infill_angle_frame,
            "What the directions of lines stand still against: plate, the machine's axes; part, the model as its file "
            "has it, so that its infill is turned with it."),
    setting(
        "infill_phase_frame", Scope::object, &InfillSettings::infill_phase_frame,
        "What the pattern stands still against: part, the middle of each object, so that copies are alike; plate, the "
        "bed's zero, so that the patterns of objects that touch go on in each other."),
    setting("infill_crossings", Scope::region, &InfillSettings::infill_crossings,
            "Where lines of two directions meet: cross, one runs over the other; bend, both turn aside, so that the "
            "nozzle strikes nothing. Where three meet, the outer two turn."),
    setting("infill_overlap", Scope::region, &InfillSettings::infill_overlap, Unit::mm, 0_mm, 5_mm,
            "How far the ends of skin and infill lines reach into the innermost wall, to bond with it; a share is of "
            "that wall's line width."),
    setting(
        "infill_connect_lines", Scope::region, &InfillSettings::infill_connect_lines,
        "Neighbouring lines, solid ones too, are joined along the wall instead of travelling from one to the next."),
    setting("infill_anchor_max", Scope::region, &InfillSettings::infill_anchor_max, Unit::mm, 0_mm, 1000_mm,
            "Longest joint along the wall between two sparse lines; auto is three times their distance."),
    setting("infill_anchor_length", Scope::region, &InfillSettings::infill_anchor_length, Unit::mm, 0_mm, 1000_mm,
            "How far a sparse line that is joined to none is bent along the wall that it ends at, to hold there."),
    setting("infill_wall_line_count", Scope::region, &InfillSettings::infill_wall_line_count, Unit::none, 0, 100,
            "Lines around each area of sparse infill, inside of the walls; the pattern fills what they leave."),
    setting("infill_multiplier", Scope::region, &InfillSettings::infill_multiplier, Unit::none, 1, 10,
            "So many lines side by side for each of the pattern, as much farther apart; the density stays. Not of "
            "fermat, medial, streamlines and lightning."),
    setting("infill_sparse_thickness", Scope::object, &InfillSettings::infill_sparse_thickness, Unit::mm, 0.02_mm, 5_mm,
            "Height of sparse infill, printed every so many layers at once: as many as it holds; auto is layer_height. "
            "No more than nozzle_diameter."),
    setting("infill_support_enabled", Scope::object, &InfillSettings::infill_support_enabled,
            "Sparse infill only below what is solid and does not carry itself; elsewhere the inside stays hollow."),
    setting("infill_support_angle", Scope::object, &InfillSettings::infill_support_angle, Unit::degrees, 0, 90,
            "With infill_support_enabled: a shell that leans less than this from the vertical carries itself."),
    setting("lightning_infill_support_angle", Scope::object, &InfillSettings::lightning_infill_support_angle,
            Unit::degrees, 5, 80, "How far branches of the pattern lightning lean, against the vertical."),
    setting("lightning_infill_overhang_angle", Scope::object, &InfillSettings::lightning_infill_overhang_angle,
            Unit::degrees, 0, 89,
            "What hangs beside a wall needs no branch as far as a layer may lean over the one below, against the "
            "vertical; auto: as far as branches are apart."),
    setting("lightning_infill_prune_angle", Scope::object, &InfillSettings::lightning_infill_prune_angle, Unit::degrees,
            5, 80, "How far their tips draw back downwards; auto is lightning_infill_support_angle."),
    setting("lightning_infill_straightening_angle", Scope::object,
            &InfillSettings::lightning_infill_straightening_angle, Unit::degrees, 5, 80,
            "How far their bends move downwards to become straight; auto is lightning_infill_support_angle."),
    setting("infill_pattern_by_density", Scope::region, &InfillSettings::infill_pattern_by_density,
            "Patterns by the density that varies, %:pattern, each from its density on: 0:honeycomb, 30:grid, "
            "70:concentric. Empty: infill_pattern everywhere."),
    setting(
        "infill_direction_field", Scope::region, &InfillSettings::infill_direction_field,
        "Directions that the pattern streamlines follows: VTK's .vtk (STRUCTURED_POINTS with VECTORS or TENSORS, of "
        "which it takes the larger principal stress), or .csv with x, y, z, sxx, syy, szz, sxy, syz, szx. The path "
        "is relative to the file that names it."),
    setting("infill_density_by_distance", Scope::region, &InfillSettings::infill_density_by_distance, Unit::none, 0,
            1000000,
            "Density by the distance from the object's surface, mm:%, straight between: 0:60, 2:30, 8:10. A distance "
            "given twice is a step. Empty: none."),
    setting("infill_density_by_height", Scope::region, &InfillSettings::infill_density_by_height, Unit::none, 0,
            1000000, "Density by the height over the bed, mm:%, as infill_density_by_distance."),
    setting("gradual_infill_steps", Scope::region, &InfillSettings::gradual_infill_steps, Unit::none, 0, 10,
            "How often the density is halved with growing distance below what is above the infill."),
    setting("gradual_infill_step_height", Scope::region, &InfillSettings::gradual_infill_step_height, Unit::mm, 0.01_mm,
            1000_mm, "Height of one step of gradual_infill_steps."),
    setting(
        "infill_density_image", Scope::region, &InfillSettings::infill_density_image,
        "A picture, .png or .pgm, seen from above: black is infill_density_max, white infill_density_min. The path is "
        "relative to the file that names it."),
    setting("infill_density_image_box", Scope::region, &InfillSettings::infill_density_image_box,
            "Two corners between which the picture lies on the bed; empty: the object's box."),
    setting("infill_density_field", Scope::region, &InfillSettings::infill_density_field,
            "A grid of densities in space: VTK's .vtk (STRUCTURED_POINTS) or .vti, or .csv with x, y, z, density. The "
            "path is "
            "relative to the file that names it."),
    setting("infill_density_field_unit", Scope::region, &InfillSettings::infill_density_field_unit,
            "What the numbers of infill_density_field are."),
    setting("infill_density_transfer", Scope::region, &InfillSettings::infill_density_transfer,
            "What becomes of the values of picture and grid: linear; simp:3, ramp:8, the density of the stiffness that "
            "they are; heaviside:16:0.5, sharpness and threshold; linear_spacing, exponential_spacing, where not the "
            "density but the distance of lines follows them."),
    setting("infill_density_dither", Scope::region, &InfillSettings::infill_density_dither,
            "Between two densities that a pattern has without changing its lines' width: none, lines get wider and "
            "narrower; floyd_steinberg, blue_noise, cells of one and of the other, so that their mean is right."),
    setting("infill_density_combine", Scope::region, &InfillSettings::infill_density_combine,
            "Where several of these densities are asked for: max, min, or multiply, their product."),
    setting("infill_modifiers", Scope::plate, &InfillSettings::infill_modifiers,
            "Meshes in the models' coordinates with a density, and a pattern, of their own: boss.stl:80, "
            "core.stl:5:gyroid; where they overlap the last wins. Paths are relative to the file that names them."),
    setting("infill_density_min", Scope::region, &InfillSettings::infill_density_min, Unit::percent, 0, 100,
            "No density that varies is less."),
    setting("infill_density_max", Scope::region, &InfillSettings::infill_density_max, Unit::percent, 0, 100,
            "No density that varies is more."),
};
static_assert(complete<InfillSettings>(infill_schema));

}  // namespace weft
