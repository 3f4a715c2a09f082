// SPDX-License-Identifier: GPL-3.0-or-later
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
  SpeedOrShare speed_overhang_25 = {100, true};
  SpeedOrShare speed_overhang_50 = {80, true};
  SpeedOrShare speed_overhang_75 = {60, true};
  SpeedOrShare speed_overhang_100 = {50, true};
  double speed_infill = 80;
  double speed_topbottom = 60;
  double speed_top_skin = 40;
  double speed_bridge = 30;
  double speed_ironing = 15;
  double speed_gap_fill = 30;
  double speed_support_infill = 60;
  double speed_support_interface = 40;
  std::optional<double> skirt_brim_speed;
  double speed_travel = 150;
  double speed_z_hop = 10;
  SpeedOrShare speed_layer_0 = {20, false};
  std::optional<double> speed_topbottom_layer_0;
  std::optional<double> speed_travel_layer_0;
  double speed_equalize_flow_width_factor = 0;
  std::optional<double> max_extrusion_rate_slope;
  std::optional<double> max_extrusion_rate_slope_down;
  double speed_curvature_even = 0;
  bool acceleration_enabled = false;
  double acceleration_print = 1500;
  std::optional<double> acceleration_wall_0;
  std::optional<double> acceleration_wall_x;
  std::optional<double> acceleration_infill;
  std::optional<double> acceleration_topbottom;
  std::optional<double> acceleration_top_skin;
  std::optional<double> acceleration_bridge;
  std::optional<double> acceleration_overhang;
  std::optional<double> acceleration_layer_0;
  std::optional<double> acceleration_travel;
};

inline constexpr Rows speed_schema{
    setting("speed_wall_0", Scope::region, &SpeedSettings::speed_wall_0, Unit::mm_s, 0.1, 5000,
            "Speed of the outermost walls."),
    setting("speed_wall_x", Scope::region, &SpeedSettings::speed_wall_x, Unit::mm_s, 0.1, 5000,
            "Speed of the other walls."),
    setting("speed_small_perimeter", Scope::region, &SpeedSettings::speed_small_perimeter, Unit::mm_s, 0.1, 5000,
            "Speed of closed walls up to small_perimeter_length; a share is of the wall's own speed; auto: no slower "
            "than others."),
    setting("small_perimeter_length", Scope::region, &SpeedSettings::small_perimeter_length, Unit::mm, 0_mm, 1000_mm,
            "Closed walls up to this length take speed_small_perimeter."),
    setting(
        "speed_overhang", Scope::region, &SpeedSettings::speed_overhang, Unit::mm_s, 0.1, 5000,
        "Speed of walls that lie over air with their whole width; a share is of speed_wall_0. So it is with skin that "
        "is no bridge; a share is of speed_topbottom there."),
    setting(
        "speed_overhang_25", Scope::region, &SpeedSettings::speed_overhang_25, Unit::mm_s, 0.1, 5000,
        "Speed of walls, and skin, that lie over air with a tenth to a quarter of their width; a share is of their own "
        "speed. Nothing gets faster over air."),
    setting("speed_overhang_50", Scope::region, &SpeedSettings::speed_overhang_50, Unit::mm_s, 0.1, 5000,
            "The same with a quarter to a half of their width."),
    setting("speed_overhang_75", Scope::region, &SpeedSettings::speed_overhang_75, Unit::mm_s, 0.1, 5000,
            "The same with a half to three quarters of their width."),
    setting("speed_overhang_100", Scope::region, &SpeedSettings::speed_overhang_100, Unit::mm_s, 0.1, 5000,
            "The same with more than three quarters of their width; with all of it they take speed_overhang."),
    setting("speed_infill", Scope::region, &SpeedSettings::speed_infill, Unit::mm_s, 0.1, 5000,
            "Speed of sparse infill."),
    setting("speed_topbottom", Scope::region, &SpeedSettings::speed_topbottom, Unit::mm_s, 0.1, 5000,
            "Speed of bottoms and of solid infill inside."),
    setting("speed_top_skin", Scope::region, &SpeedSettings::speed_top_skin, Unit::mm_s, 0.1, 5000,
            "Speed of top surfaces."),
    setting("speed_bridge", Scope::region, &SpeedSettings::speed_bridge, Unit::mm_s, 0.1, 5000,
            "Speed of strands over air."),
    setting("speed_ironing", Scope::region, &SpeedSettings::speed_ironing, Unit::mm_s, 0.1, 5000, "Speed of ironing."),
    setting("speed_gap_fill", Scope::region, &SpeedSettings::speed_gap_fill, Unit::mm_s, 0.1, 5000,
            "Speed of what fills gaps between walls."),
    setting("speed_support_infill", Scope::region, &SpeedSettings::speed_support_infill, Unit::mm_s, 0.1, 5000,
            "Speed of support, and of all but the surface of a raft."),
    setting("speed_support_interface", Scope::region, &SpeedSettings::speed_support_interface, Unit::mm_s, 0.1, 5000,
            "Speed of the interfaces of support, and of the surface of a raft."),
    setting("skirt_brim_speed", Scope::plate, &SpeedSettings::skirt_brim_speed, Unit::mm_s, 0.1, 5000,
            "Speed of skirt and brim; auto: speed_wall_0, on the first layer speed_layer_0."),
    setting("speed_travel", Scope::layer, &SpeedSettings::speed_travel, Unit::mm_s, 0.1, 5000, "Speed of travels."),
    setting("speed_z_hop", Scope::layer, &SpeedSettings::speed_z_hop, Unit::mm_s, 0.1, 1000,
            "Speed along Z, in layer changes and lifts."),
    setting("speed_layer_0", Scope::region, &SpeedSettings::speed_layer_0, Unit::mm_s, 0.1, 5000,
            "Speed of the first layer, where that is slower; a share is of the feature's own speed."),
    setting("speed_topbottom_layer_0", Scope::region, &SpeedSettings::speed_topbottom_layer_0, Unit::mm_s, 0.1, 5000,
            "Speed of bottoms and of solid infill in the first layer; auto: like the rest of it, by speed_layer_0."),
    setting("speed_travel_layer_0", Scope::layer, &SpeedSettings::speed_travel_layer_0, Unit::mm_s, 0.1, 5000,
            "Speed of travels in the first layer; auto is speed_travel."),
    setting("speed_equalize_flow_width_factor", Scope::region, &SpeedSettings::speed_equalize_flow_width_factor,
            Unit::percent, 0, 100,
            "How far the speed of walls, gap fill and sparse infill follows their width: at 100 % mm³/s stay what they "
            "are at nominal width, and layers whose infill is longer take no longer; at 0 % the speed stays."),
    setting("max_extrusion_rate_slope", Scope::tool, &SpeedSettings::max_extrusion_rate_slope, Unit::mm3_s2, 0.1,
            100000, "How fast mm³/s may grow along beads, so that the pressure in the nozzle follows; auto: no limit."),
    setting("max_extrusion_rate_slope_down", Scope::tool, &SpeedSettings::max_extrusion_rate_slope_down, Unit::mm3_s2,
            0.1, 100000, "How fast mm³/s may fall; auto is max_extrusion_rate_slope."),
    setting("speed_curvature_even", Scope::region, &SpeedSettings::speed_curvature_even, Unit::percent, 0, 100,
            "How far outermost walls keep one speed along a curve, the lowest that the machine comes down to in it: "
            "what is printed at one speed shines alike."),
    setting("acceleration_enabled", Scope::plate, &SpeedSettings::acceleration_enabled,
            "Accelerations are written to the G-code; off: the firmware's own stay in force."),
    setting("acceleration_print", Scope::region, &SpeedSettings::acceleration_print, Unit::mm_s2, 1, 100000,
            "Acceleration while printing; when acceleration_enabled is off, only what the estimate of time takes the "
            "firmware's to be."),
    setting("acceleration_wall_0", Scope::region, &SpeedSettings::acceleration_wall_0, Unit::mm_s2, 1, 100000,
            "Acceleration in the outermost walls; auto is acceleration_print."),
    setting("acceleration_wall_x", Scope::region, &SpeedSettings::acceleration_wall_x, Unit::mm_s2, 1, 100000,
            "Acceleration in the other walls; auto is acceleration_print."),
    setting("acceleration_infill", Scope::region, &SpeedSettings::acceleration_infill, Unit::mm_s2, 1, 100000,
            "Acceleration in sparse infill; auto is acceleration_print."),
    setting("acceleration_topbottom", Scope::region, &SpeedSettings::acceleration_topbottom, Unit::mm_s2, 1, 100000,
            "Acceleration in bottoms and solid infill; auto is acceleration_print."),
    setting("acceleration_top_skin", Scope::region, &SpeedSettings::acceleration_top_skin, Unit::mm_s2, 1, 100000,
            "Acceleration in top surfaces; auto is acceleration_topbottom."),
    setting("acceleration_bridge", Scope::region, &SpeedSettings::acceleration_bridge, Unit::mm_s2, 1, 100000,
            "Acceleration in strands over air; auto is acceleration_print."),
    setting("acceleration_overhang", Scope::region, &SpeedSettings::acceleration_overhang, Unit::mm_s2, 1, 100000,
            "Acceleration in walls that lie over air with more than half of their width; auto: that of outermost "
            "walls."),
    setting("acceleration_layer_0", Scope::region, &SpeedSettings::acceleration_layer_0, Unit::mm_s2, 1, 100000,
            "Acceleration of everything printed in the first layer; auto: as in the others."),
    setting("acceleration_travel", Scope::layer, &SpeedSettings::acceleration_travel, Unit::mm_s2, 1, 100000,
            "Acceleration of travels; auto is acceleration_print."),
};
static_assert(complete<SpeedSettings>(speed_schema));

}  // namespace weft
