// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/schema.h"

#include <array>

namespace weft {
using namespace weft::literals;

/// How the paths of a layer are put in order.
enum class PathOrder { nearest, optimized };
constexpr auto choices_of(PathOrder) {
  return std::array{Choice<PathOrder>{PathOrder::nearest, "nearest"},
                    Choice<PathOrder>{PathOrder::optimized, "optimized"}};
}

/// Where a closed wall begins and ends.
enum class SeamType { sharpest_corner, aligned, shortest, back, random, user };
constexpr auto choices_of(SeamType) {
  return std::array{Choice<SeamType>{SeamType::sharpest_corner, "sharpest_corner"},
                    Choice<SeamType>{SeamType::aligned, "aligned"},
                    Choice<SeamType>{SeamType::shortest, "shortest"},
                    Choice<SeamType>{SeamType::back, "back"},
                    Choice<SeamType>{SeamType::random, "random"},
                    Choice<SeamType>{SeamType::user, "user"}};
}

/// Which corners attract a seam.
enum class SeamCorner { none, inner, outer, any, weighted };
constexpr auto choices_of(SeamCorner) {
  return std::array{Choice<SeamCorner>{SeamCorner::none, "none"}, Choice<SeamCorner>{SeamCorner::inner, "inner"},
                    Choice<SeamCorner>{SeamCorner::outer, "outer"}, Choice<SeamCorner>{SeamCorner::any, "any"},
                    Choice<SeamCorner>{SeamCorner::weighted, "weighted"}};
}

/// Where travels stay.
enum class Combing { off, all, no_outer_surfaces, noskin, infill };
constexpr auto choices_of(Combing) {
  return std::array{Choice<Combing>{Combing::off, "off"}, Choice<Combing>{Combing::all, "all"},
                    Choice<Combing>{Combing::no_outer_surfaces, "no_outer_surfaces"},
                    Choice<Combing>{Combing::noskin, "noskin"}, Choice<Combing>{Combing::infill, "infill"}};
}

/// Order of paths, seams, and the way between them.
struct TravelSettings {
  PathOrder path_order = PathOrder::optimized;
  bool infill_before_walls = false;
  SeamType z_seam_type = SeamType::aligned;
  SeamCorner z_seam_corner = SeamCorner::weighted;
  double z_seam_visibility_weight = 0.2;
  double z_seam_corner_weight = 1;
  double z_seam_overhang_weight = 0.5;
  Um z_seam_x = 0_mm;
  Um z_seam_y = 0_mm;
  Combing retraction_combing = Combing::no_outer_surfaces;
  Um retraction_combing_offset = 0_mm;
  std::optional<Um> retraction_combing_max_distance;
  std::optional<Um> retraction_combing_max_distance_wall_0 = 5_mm;
  std::optional<LengthOrShare> retraction_combing_max_detour = length(20_mm);
  bool travel_avoid_other_parts = false;
  Um travel_avoid_distance = 0.625_mm;
  bool travel_avoid_supports = true;
  bool staggered_inner_seams = false;
  LengthOrShare seam_gap_distance = share(15);
  Um wall_0_wipe_dist = 0_mm;
  bool coasting_enable = false;
  double coasting_volume = 0.064;
  Um scarf_joint_seam_length = 0_mm;
  double scarf_joint_seam_start_height_ratio = 0;
  bool scarf_joint_inner_walls = false;
  Um scarf_split_distance = 1_mm;
};

inline constexpr Rows travel_schema{
    setting("path_order", Scope::layer, &TravelSettings::path_order,
            "Order of the paths of a layer: nearest takes the nearest next one, optimized improves that order by local "
            "search."),
    setting("infill_before_walls", Scope::plate, &TravelSettings::infill_before_walls,
            "The fills of a part are printed before its walls: walls then lie on what infill pressed out."),
    setting("z_seam_type", Scope::object, &TravelSettings::z_seam_type,
            "Where outer walls begin and end: aligned, in lines up the part along corners that last; sharpest_corner, "
            "wherever it is hidden best; at the back; user, near z_seam_x and z_seam_y; random, anywhere."),
    setting("z_seam_corner", Scope::object, &TravelSettings::z_seam_corner,
            "Which corners attract a seam; weighted prefers inner ones to outer ones."),
    setting("z_seam_visibility_weight", Scope::object, &TravelSettings::z_seam_visibility_weight, Unit::none, 0, 10,
            "How much it counts against a seam that its place is seen from many sides."),
    setting("z_seam_corner_weight", Scope::object, &TravelSettings::z_seam_corner_weight, Unit::none, 0, 10,
            "How much a sharp corner attracts a seam."),
    setting("z_seam_overhang_weight", Scope::object, &TravelSettings::z_seam_overhang_weight, Unit::none, 0, 10,
            "How much it counts against a seam that nothing lies below its place."),
    setting("z_seam_x", Scope::object, &TravelSettings::z_seam_x, Unit::mm, -10000_mm, 10000_mm,
            "X on the bed that seams are drawn to when z_seam_type is user."),
    setting("z_seam_y", Scope::object, &TravelSettings::z_seam_y, Unit::mm, -10000_mm, 10000_mm,
            "Y on the bed that seams are drawn to when z_seam_type is user."),
    setting("retraction_combing", Scope::layer, &TravelSettings::retraction_combing,
            "Travels stay inside the part: anywhere (all), off what will be seen (no_outer_surfaces), off top and "
            "bottom skin (noskin), "
            "or over infill only."),
    setting("retraction_combing_offset", Scope::layer, &TravelSettings::retraction_combing_offset, Unit::mm, -10_mm,
            10_mm,
            "Moves the boundary of combing, outwards when positive, against the centreline of the outer wall. Only "
            "with retraction_combing = all."),
    setting("retraction_combing_max_distance", Scope::layer, &TravelSettings::retraction_combing_max_distance, Unit::mm,
            0_mm, 10000_mm, "Combed travels longer than this are retracted; auto: never for their length."),
    setting("retraction_combing_max_distance_wall_0", Scope::layer,
            &TravelSettings::retraction_combing_max_distance_wall_0, Unit::mm, 0_mm, 10000_mm,
            "Combed travels to an outer wall longer than this, and than retraction_min_travel, are retracted: what the "
            "nozzle loses on the way is missing where the wall, which is seen, begins; auto: as travels to other "
            "beads."),
    setting("retraction_combing_max_detour", Scope::layer, &TravelSettings::retraction_combing_max_detour, Unit::mm,
            0_mm, 10000_mm,
            "Combed travels longer than the straight way by more than this go straight and are retracted; a share is "
            "of the straight way; "
            "auto: combed however long."),
    setting("travel_avoid_other_parts", Scope::layer, &TravelSettings::travel_avoid_other_parts,
            "Retracted travels go round the other parts of the layer instead of over them."),
    setting("travel_avoid_distance", Scope::layer, &TravelSettings::travel_avoid_distance, Unit::mm, 0_mm, 100_mm,
            "How far travels keep from the parts that they go round."),
    setting("travel_avoid_supports", Scope::layer, &TravelSettings::travel_avoid_supports,
            "Travels go round support, which a nozzle that runs into it knocks over, where the way round is not long."),
    setting("staggered_inner_seams", Scope::region, &TravelSettings::staggered_inner_seams,
            "Seams of inner walls lie aside of the outer wall's, alternately, so that no gap runs through all walls."),
    setting("seam_gap_distance", Scope::region, &TravelSettings::seam_gap_distance, Unit::mm, 0_mm, 5_mm,
            "Closed walls end this far before the place where they began: what the nozzle still holds closes the loop. "
            "A share is of nozzle_diameter."),
    setting("wall_0_wipe_dist", Scope::region, &TravelSettings::wall_0_wipe_dist, Unit::mm, 0_mm, 10_mm,
            "How far the nozzle runs on over an outer wall without extruding after closing it."),
    setting("coasting_enable", Scope::tool, &TravelSettings::coasting_enable,
            "The end of a bead before a retraction is not extruded: the pressure in the nozzle prints it."),
    setting("coasting_volume", Scope::tool, &TravelSettings::coasting_volume, Unit::mm3, 0, 10,
            "Volume left out; beads of less than three times as much are not touched."),
    setting("scarf_joint_seam_length", Scope::region, &TravelSettings::scarf_joint_seam_length, Unit::mm, 0_mm, 100_mm,
            "Outer walls begin on a ramp of this length and end above it, so that the seam is a slanting joint; 0: "
            "they begin and end at one place."),
    setting("scarf_joint_seam_start_height_ratio", Scope::region, &TravelSettings::scarf_joint_seam_start_height_ratio,
            Unit::percent, 0, 100, "Height of a scarf seam's ramp at its beginning; a share of the layer height."),
    setting("scarf_joint_inner_walls", Scope::region, &TravelSettings::scarf_joint_inner_walls,
            "The other walls have scarf seams too; off: the outermost alone."),
    setting("scarf_split_distance", Scope::region, &TravelSettings::scarf_split_distance, Unit::mm, 0.05_mm, 100_mm,
            "Longest piece of a scarf seam's ramp that is printed at one rate of flow."),
};
static_assert(complete<TravelSettings>(travel_schema));

}  // namespace weft
