#pragma once
#include "settings/schema.h"

namespace weft {
using namespace weft::literals;

/// How fast, and how hard the machine is pushed.
struct SpeedSettings {
  double speed_wall_0 = 40;
  double speed_wall_x = 60;
  std::optional<SpeedOrShare> speed_small_perimeter = SpeedOrShare{50, true};
  Um small_perimeter_length = 20_mm;
  SpeedOrShare speed_overhang = {50, true};
  double speed_infill = 80;
  double speed_topbottom = 60;
  double speed_top_skin = 40;
  double speed_bridge = 30;
  double speed_gap_fill = 30;
  std::optional<double> skirt_brim_speed;
  double speed_travel = 150;
  double speed_z_hop = 10;
  SpeedOrShare speed_layer_0 = {20, false};
  std::optional<double> speed_travel_layer_0;
  double speed_equalize_flow_width_factor = 0;
  std::optional<double> max_extrusion_rate_slope;
  bool acceleration_enabled = false;
  double acceleration_print = 1500;
  std::optional<double> acceleration_wall_0;
  std::optional<double> acceleration_wall_x;
  std::optional<double> acceleration_infill;
  std::optional<double> acceleration_topbottom;
  std::optional<double> acceleration_top_skin;
  std::optional<double> acceleration_bridge;
  std::optional<double> acceleration_layer_0;
  std::optional<double> acceleration_travel;
};

inline constexpr std::tuple speed_schema{
    setting("speed_wall_0", &SpeedSettings::speed_wall_0, Unit::mm_s, 0.1, 5000, "Speed of the outermost walls.",
            "external_perimeter_speed"),
    setting("speed_wall_x", &SpeedSettings::speed_wall_x, Unit::mm_s, 0.1, 5000, "Speed of the other walls.",
            "perimeter_speed"),
    setting("speed_small_perimeter", &SpeedSettings::speed_small_perimeter, Unit::mm_s, 0.1, 5000,
            "Speed of closed walls up to small_perimeter_length; a share is of the wall's own speed; auto: no slower "
            "than others.",
            "small_perimeter_speed"),
    setting("small_perimeter_length", &SpeedSettings::small_perimeter_length, Unit::mm, 0_mm, 1000_mm,
            "Closed walls up to this length take speed_small_perimeter."),
    setting("speed_overhang", &SpeedSettings::speed_overhang, Unit::mm_s, 0.1, 5000,
            "Speed of walls that overhang; a share is of speed_wall_0."),
    setting("speed_infill", &SpeedSettings::speed_infill, Unit::mm_s, 0.1, 5000, "Speed of sparse infill.",
            "infill_speed"),
    setting("speed_topbottom", &SpeedSettings::speed_topbottom, Unit::mm_s, 0.1, 5000,
            "Speed of bottoms and of solid infill inside.", "solid_infill_speed"),
    setting("speed_top_skin", &SpeedSettings::speed_top_skin, Unit::mm_s, 0.1, 5000, "Speed of top surfaces.",
            "top_solid_infill_speed"),
    setting("speed_bridge", &SpeedSettings::speed_bridge, Unit::mm_s, 0.1, 5000, "Speed of strands over air.",
            "bridge_speed"),
    setting("speed_gap_fill", &SpeedSettings::speed_gap_fill, Unit::mm_s, 0.1, 5000,
            "Speed of what fills gaps between walls.", "gap_fill_speed"),
    setting("skirt_brim_speed", &SpeedSettings::skirt_brim_speed, Unit::mm_s, 0.1, 5000,
            "Speed of skirt and brim; auto: speed_wall_0, on the first layer speed_layer_0."),
    setting("speed_travel", &SpeedSettings::speed_travel, Unit::mm_s, 0.1, 5000, "Speed of travels.", "travel_speed"),
    setting("speed_z_hop", &SpeedSettings::speed_z_hop, Unit::mm_s, 0.1, 1000,
            "Speed along Z, in layer changes and lifts.", "travel_speed_z"),
    setting("speed_layer_0", &SpeedSettings::speed_layer_0, Unit::mm_s, 0.1, 5000,
            "Speed of the first layer, where that is slower; a share is of the feature's own speed.",
            "first_layer_speed"),
    setting("speed_travel_layer_0", &SpeedSettings::speed_travel_layer_0, Unit::mm_s, 0.1, 5000,
            "Speed of travels in the first layer; auto is speed_travel."),
    setting("speed_equalize_flow_width_factor", &SpeedSettings::speed_equalize_flow_width_factor, Unit::percent, 0, 100,
            "How far the speed of walls and gap fill follows their width: at 100 % mm³/s stay what they are at nominal "
            "width, at 0 % the "
            "speed stays."),
    setting("max_extrusion_rate_slope", &SpeedSettings::max_extrusion_rate_slope, Unit::mm3_s2, 0.1, 100000,
            "How fast mm³/s may change along a bead; auto: no limit.", "max_volumetric_extrusion_rate_slope_positive"),
    setting("acceleration_enabled", &SpeedSettings::acceleration_enabled,
            "Accelerations are written to the G-code; off: the firmware's own stay in force."),
    setting("acceleration_print", &SpeedSettings::acceleration_print, Unit::mm_s2, 1, 100000,
            "Acceleration while printing; when acceleration_enabled is off, only what the estimate of time takes the "
            "firmware's to be.",
            "default_acceleration"),
    setting("acceleration_wall_0", &SpeedSettings::acceleration_wall_0, Unit::mm_s2, 1, 100000,
            "Acceleration in the outermost walls; auto is acceleration_print.", "external_perimeter_acceleration"),
    setting("acceleration_wall_x", &SpeedSettings::acceleration_wall_x, Unit::mm_s2, 1, 100000,
            "Acceleration in the other walls; auto is acceleration_print.", "perimeter_acceleration"),
    setting("acceleration_infill", &SpeedSettings::acceleration_infill, Unit::mm_s2, 1, 100000,
            "Acceleration in sparse infill; auto is acceleration_print.", "infill_acceleration"),
    setting("acceleration_topbottom", &SpeedSettings::acceleration_topbottom, Unit::mm_s2, 1, 100000,
            "Acceleration in bottoms and solid infill; auto is acceleration_print.", "solid_infill_acceleration"),
    setting("acceleration_top_skin", &SpeedSettings::acceleration_top_skin, Unit::mm_s2, 1, 100000,
            "Acceleration in top surfaces; auto is acceleration_topbottom.", "top_solid_infill_acceleration"),
    setting("acceleration_bridge", &SpeedSettings::acceleration_bridge, Unit::mm_s2, 1, 100000,
            "Acceleration in strands over air; auto is acceleration_print.", "bridge_acceleration"),
    setting("acceleration_layer_0", &SpeedSettings::acceleration_layer_0, Unit::mm_s2, 1, 100000,
            "Acceleration of everything printed in the first layer; auto: as in the others.",
            "first_layer_acceleration"),
    setting("acceleration_travel", &SpeedSettings::acceleration_travel, Unit::mm_s2, 1, 100000,
            "Acceleration of travels; auto is acceleration_print.", "travel_acceleration"),
};
static_assert(complete<SpeedSettings>(speed_schema));

}  // namespace weft
