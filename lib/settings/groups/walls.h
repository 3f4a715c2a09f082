// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/schema.h"

#include <array>

namespace weft {
using namespace weft::literals;

/// Which wall of a part is printed first.
enum class WallOrder { inside_out, outside_in, outer_inner_outer };
constexpr auto choices_of(WallOrder) {
  return std::array{Choice<WallOrder>{WallOrder::inside_out, "inside_out"},
                    Choice<WallOrder>{WallOrder::outside_in, "outside_in"},
                    Choice<WallOrder>{WallOrder::outer_inner_outer, "outer_inner_outer"}};
}

/// What of the outermost bead lies on the outline.
enum class WallOutline {
  widest,  ///< the widest point of its rounded side: the part measures by calliper what its model does
  volume,  ///< the side of the rectangle that holds its plastic: what rounded sides bulge out, they lack above and
           ///< below
};
constexpr auto choices_of(WallOutline) {
  return std::array{Choice<WallOutline>{WallOutline::widest, "widest"},
                    Choice<WallOutline>{WallOutline::volume, "volume"}};
}

/// Where a part gets a single wall.
enum class OneWall {
  none,
  top,      ///< wherever nothing lies above
  topmost,  ///< on the last layer
};
constexpr auto choices_of(OneWall) {
  return std::array{Choice<OneWall>{OneWall::none, "none"}, Choice<OneWall>{OneWall::top, "top"},
                    Choice<OneWall>{OneWall::topmost, "topmost"}};
}

/// What of a rough wall moves.
enum class FuzzyMode {
  displacement,  ///< all of it
  width,         ///< its outer edge: the inner one stays, and no gap opens beside it
};
constexpr auto choices_of(FuzzyMode) {
  return std::array{Choice<FuzzyMode>{FuzzyMode::displacement, "displacement"},
                    Choice<FuzzyMode>{FuzzyMode::width, "width"}};
}

/// What rough walls stand off by.
enum class FuzzyNoise {
  classic,  ///< by chance, each point for itself
  perlin,   ///< waves
  billow,   ///< cushions
  ridged,   ///< crests
  voronoi,  ///< plates
};
constexpr auto choices_of(FuzzyNoise) {
  return std::array{Choice<FuzzyNoise>{FuzzyNoise::classic, "classic"},
                    Choice<FuzzyNoise>{FuzzyNoise::perlin, "perlin"}, Choice<FuzzyNoise>{FuzzyNoise::billow, "billow"},
                    Choice<FuzzyNoise>{FuzzyNoise::ridged, "ridged"},
                    Choice<FuzzyNoise>{FuzzyNoise::voronoi, "voronoi"}};
}

/// Beads along the outlines.
struct WallSettings {
  int wall_line_count = 3;
  std::optional<LengthOrShare> wall_line_width_0;
  std::optional<LengthOrShare> wall_line_width_x;
  LengthOrShare min_wall_line_width = share(85);
  std::optional<LengthOrShare> min_even_wall_line_width;
  std::optional<LengthOrShare> min_odd_wall_line_width;
  LengthOrShare max_wall_line_width = share(225);
  int wall_distribution_count = 1;
  LengthOrShare wall_transition_length = share(100);
  double wall_transition_angle = 25;
  Um wall_transition_filter_distance = 1_mm;
  Um min_feature_size = 0.05_mm;
  Um min_wall_length = 0.1_mm;
  double wall_corner_width = 100;
  bool flow_compensation = true;
  Um min_output_width = 0.2_mm;
  double min_flow_ratio = 5;
  double max_flow_ratio = 100;
  WallOutline wall_outline = WallOutline::widest;
  double overlap_factor = 1;
  WallOrder wall_order = WallOrder::inside_out;
  bool alternate_extra_wall = false;
  bool wall_extra_on_slopes = false;
  OneWall top_one_wall = OneWall::none;
  bool initial_layer_one_wall = false;
  bool magic_fuzzy_skin_enabled = false;
  bool magic_fuzzy_skin_outside_only = true;
  Um magic_fuzzy_skin_thickness = 0.3_mm;
  Um magic_fuzzy_skin_point_dist = 0.8_mm;
  FuzzyMode fuzzy_skin_mode = FuzzyMode::displacement;
  FuzzyNoise fuzzy_skin_noise = FuzzyNoise::classic;
  Um fuzzy_skin_scale = 1_mm;
  int fuzzy_skin_octaves = 4;
  int fuzzy_skin_seed = 0;
  Um xy_offset = 0_mm;
  Um xy_offset_layer_0 = 0_mm;
  Um hole_xy_offset = 0_mm;
  std::optional<Um> hole_xy_offset_max_diameter;
};

inline constexpr Rows wall_schema{
    setting("wall_line_count", Scope::region, &WallSettings::wall_line_count, Unit::none, 0, 1000,
            "Walls on each side of the part."),
    setting("wall_line_width_0", Scope::region, &WallSettings::wall_line_width_0, Unit::mm, 0.05_mm, 5_mm,
            "Line width of the outermost wall; auto is 1.05 × nozzle_diameter; a share is of nozzle_diameter."),
    setting(
        "wall_line_width_x", Scope::region, &WallSettings::wall_line_width_x, Unit::mm, 0.05_mm, 5_mm,
        "Line width of the other walls; auto keeps the cross-section of the nozzle; a share is of nozzle_diameter."),
    setting("min_wall_line_width", Scope::region, &WallSettings::min_wall_line_width, Unit::mm, 0.001_mm, 5_mm,
            "Narrowest wall where there is room for another choice; a share is of nozzle_diameter."),
    setting("min_even_wall_line_width", Scope::region, &WallSettings::min_even_wall_line_width, Unit::mm, 0.001_mm,
            5_mm,
            "The middle wall of a thin part becomes two when each is at least this wide; auto is min_wall_line_width."),
    setting("min_odd_wall_line_width", Scope::region, &WallSettings::min_odd_wall_line_width, Unit::mm, 0.001_mm, 5_mm,
            "A middle wall is added when it is at least this wide; auto is min_wall_line_width."),
    setting("max_wall_line_width", Scope::region, &WallSettings::max_wall_line_width, Unit::mm, 0.05_mm, 10_mm,
            "Widest wall: what does not fit becomes another wall; a share is of nozzle_diameter."),
    setting("wall_distribution_count", Scope::region, &WallSettings::wall_distribution_count, Unit::none, 1, 1000,
            "How many of the innermost walls on each side share the difference between the part's thickness and the "
            "nominal widths."),
    setting("wall_transition_length", Scope::region, &WallSettings::wall_transition_length, Unit::mm, 0.001_mm, 100_mm,
            "Length over which a wall is added or removed; a share is of nozzle_diameter."),
    setting("wall_transition_angle", Scope::region, &WallSettings::wall_transition_angle, Unit::degrees, 1, 120,
            "Parts that taper at a larger angle are corners: their walls turn back instead of being merged; only "
            "where there is room for one bead it is led into the tip, up to 45°."),
    setting("wall_transition_filter_distance", Scope::region, &WallSettings::wall_transition_filter_distance, Unit::mm,
            0_mm, 1000_mm, "A change of the number of walls that is undone within this length is left out."),
    setting("min_feature_size", Scope::region, &WallSettings::min_feature_size, Unit::mm, 0.001_mm, 5_mm,
            "Parts thinner than this are left out."),
    setting("min_wall_length", Scope::region, &WallSettings::min_wall_length, Unit::mm, 0_mm, 100_mm,
            "Shorter middle walls are left out."),
    setting("wall_corner_width", Scope::region, &WallSettings::wall_corner_width, Unit::percent, 50, 100,
            "Width of a wall where it bends around a convex corner of up to 100°, as a share of its width (of "
            "wall_line_width_0 where the outermost is wider): narrower walls reach further into corners, and leave "
            "smaller gaps between each other; never below min_output_width; 100 keeps the width."),
    setting("flow_compensation", Scope::region, &WallSettings::flow_compensation,
            "Walls too narrow for a steady strand are planned at min_output_width with less flow."),
    setting("min_output_width", Scope::region, &WallSettings::min_output_width, Unit::mm, 0.01_mm, 5_mm,
            "Narrowest planned wall; a quarter of the line width when that is more."),
    setting("min_flow_ratio", Scope::region, &WallSettings::min_flow_ratio, Unit::percent, 0.1, 100,
            "Least flow of a compensated wall."),
    setting("max_flow_ratio", Scope::region, &WallSettings::max_flow_ratio, Unit::percent, 1, 200,
            "Most flow of a compensated wall."),
    setting(
        "wall_outline", Scope::region, &WallSettings::wall_outline,
        "What lies on the outline: widest, the widest point of the outermost bead's rounded side, so that callipers "
        "measure the model's size and pins fit its holes; volume, the side of a rectangle of the bead's height and "
        "volume, which bulges 0.11 × its height outside."),
    setting("overlap_factor", Scope::object, &WallSettings::overlap_factor, Unit::none, 0, 1,
            "How far neighbouring beads are moved together for the gaps that their rounded sides leave: at 1 they fill "
            "them, at 0 they only touch."),
    setting("wall_order", Scope::region, &WallSettings::wall_order, "Which wall of a part is printed first."),
    setting("alternate_extra_wall", Scope::region, &WallSettings::alternate_extra_wall,
            "One more wall on every second layer."),
    setting("wall_extra_on_slopes", Scope::region, &WallSettings::wall_extra_on_slopes,
            "More walls where the layer above stands further in than the walls reach, so that its outer walls lie on "
            "walls."),
    setting("top_one_wall", Scope::region, &WallSettings::top_one_wall,
            "A single wall around top surfaces, so that their lines reach further: top, wherever nothing lies above; "
            "topmost, on the last layer; none."),
    setting("initial_layer_one_wall", Scope::region, &WallSettings::initial_layer_one_wall,
            "A single wall in the first layer."),
    setting("magic_fuzzy_skin_enabled", Scope::region, &WallSettings::magic_fuzzy_skin_enabled,
            "Outer walls are rough, above the first layer: points along them stand off by chance. The same seed gives "
            "the same walls."),
    setting("magic_fuzzy_skin_outside_only", Scope::region, &WallSettings::magic_fuzzy_skin_outside_only,
            "Holes stay smooth."),
    setting("magic_fuzzy_skin_thickness", Scope::region, &WallSettings::magic_fuzzy_skin_thickness, Unit::mm, 0.001_mm,
            5_mm, "How far a rough wall stands off its place, to either side."),
    setting("magic_fuzzy_skin_point_dist", Scope::region, &WallSettings::magic_fuzzy_skin_point_dist, Unit::mm, 0.05_mm,
            50_mm, "Distance of the points that stand off, on average."),
    setting("fuzzy_skin_mode", Scope::region, &WallSettings::fuzzy_skin_mode,
            "What of a rough wall moves: displacement, all of it; width, its outer edge, so that no gap opens to the "
            "next wall."),
    setting("fuzzy_skin_noise", Scope::region, &WallSettings::fuzzy_skin_noise,
            "What rough walls stand off by: classic, each point for itself; perlin, waves; billow, cushions; ridged, "
            "crests; voronoi, plates. All but the first go on from layer to layer."),
    setting("fuzzy_skin_scale", Scope::region, &WallSettings::fuzzy_skin_scale, Unit::mm, 0.1_mm, 500_mm,
            "Size of those waves, cushions, crests and plates."),
    setting("fuzzy_skin_octaves", Scope::region, &WallSettings::fuzzy_skin_octaves, Unit::none, 1, 10,
            "How often half as large ones, half as high, are laid over them; not over plates."),
    setting("fuzzy_skin_seed", Scope::region, &WallSettings::fuzzy_skin_seed, Unit::none, 0, 1000000,
            "Another number gives other rough walls."),
    setting("xy_offset", Scope::region, &WallSettings::xy_offset, Unit::mm, -10_mm, 10_mm,
            "Moves all outlines outwards (a negative value inwards)."),
    setting("xy_offset_layer_0", Scope::region, &WallSettings::xy_offset_layer_0, Unit::mm, -10_mm, 10_mm,
            "Moves the outlines of the first layer further outwards; negative against an elephant foot."),
    setting("hole_xy_offset", Scope::region, &WallSettings::hole_xy_offset, Unit::mm, -10_mm, 10_mm,
            "Widens holes (a negative value narrows them), besides xy_offset."),
    setting(
        "hole_xy_offset_max_diameter", Scope::region, &WallSettings::hole_xy_offset_max_diameter, Unit::mm, 0.1_mm,
        1000_mm,
        "Small holes shrink most: hole_xy_offset holds less the larger a hole is, and not at all from this diameter "
        "on; auto: it holds for all holes."),
};
static_assert(complete<WallSettings>(wall_schema));

}  // namespace weft
