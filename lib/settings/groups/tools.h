// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/schema.h"

#include <array>
#include <string>

namespace weft {
using namespace weft::literals;

/// In which order the tools of a layer follow each other: with the least purging and waiting over the whole print, by
/// number, or by number from the one that is loaded.
enum class ToolOrder { least, fixed, cyclic };
constexpr auto choices_of(ToolOrder) {
  return std::array{Choice<ToolOrder>{ToolOrder::least, "least"}, Choice<ToolOrder>{ToolOrder::fixed, "fixed"},
                    Choice<ToolOrder>{ToolOrder::cyclic, "cyclic"}};
}

/// How a tool is chosen: in the firmware's own way, by T on every firmware, or by the user, who swaps the filament.
enum class ToolSelect { firmware, t, swap };
constexpr auto choices_of(ToolSelect) {
  return std::array{Choice<ToolSelect>{ToolSelect::firmware, "firmware"}, Choice<ToolSelect>{ToolSelect::t, "t"},
                    Choice<ToolSelect>{ToolSelect::swap, "swap"}};
}

/// What a tower has beside its walls, to stand by: nothing, ribs at its corners, or a cone around its foot.
enum class TowerShape { plain, ribs, cone };
constexpr auto choices_of(TowerShape) {
  return std::array{Choice<TowerShape>{TowerShape::plain, "plain"}, Choice<TowerShape>{TowerShape::ribs, "ribs"},
                    Choice<TowerShape>{TowerShape::cone, "cone"}};
}

/// Along what a gradient runs.
enum class GradientAxis { x, y, z };
constexpr auto choices_of(GradientAxis) {
  return std::array{Choice<GradientAxis>{GradientAxis::x, "x"}, Choice<GradientAxis>{GradientAxis::y, "y"},
                    Choice<GradientAxis>{GradientAxis::z, "z"}};
}

/// How a share of a filament is made: by whole lines, by stripes across the axis, by whole layers, or in the nozzle.
enum class GradientMode { lines, stripes, layers, mix };
constexpr auto choices_of(GradientMode) {
  return std::array{
      Choice<GradientMode>{GradientMode::lines, "lines"}, Choice<GradientMode>{GradientMode::stripes, "stripes"},
      Choice<GradientMode>{GradientMode::layers, "layers"}, Choice<GradientMode>{GradientMode::mix, "mix"}};
}

/// Which tools there are, what each of them prints, how one follows the other, and what happens at heights. A tool is
/// one filament in one nozzle, counted from 0.
struct ToolSettings {
  std::optional<int> extruders_enabled_count;
  ToolValues tool_settings;
  std::optional<int> tool_nozzles;
  ToolSelect tool_select = ToolSelect::firmware;
  ToolOrder tool_order = ToolOrder::least;
  double tool_change_time = 0;
  std::optional<Rgb> filament_colour;
  std::optional<int> material_print_temperature_min;
  std::optional<int> material_print_temperature_max;
  bool material_soluble = false;
  int material_nozzle_hardness = 0;
  std::optional<int> machine_nozzle_hardness;
  std::string machine_bed_plate;
  std::string material_plates;
  int extruder_nr = 0;
  std::optional<int> wall_extruder_nr;
  std::optional<int> wall_0_extruder_nr;
  std::optional<int> wall_x_extruder_nr;
  std::optional<int> infill_extruder_nr;
  std::optional<int> top_bottom_extruder_nr;
  std::optional<int> roofing_extruder_nr;
  std::optional<int> adhesion_extruder_nr;
  Um switch_extruder_retraction_amount = 10_mm;
  Um switch_extruder_extra_prime_amount = 0_mm;
  std::string filament_ramming_parameters;
  double filament_multitool_ramming_volume = 0;
  double filament_multitool_ramming_flow = 10;
  double filament_unloading_speed_start = 100;
  double filament_unloading_speed = 90;
  double filament_loading_speed_start = 3;
  double filament_loading_speed = 28;
  int filament_cooling_moves = 4;
  double filament_cooling_initial_speed = 2.2;
  double filament_cooling_final_speed = 3.4;
  Um filament_stamping_distance = 0_mm;
  double filament_stamping_loading_speed = 20;
  double filament_toolchange_delay = 0;
  Um parking_pos_retraction = 0_mm;
  Um cooling_tube_retraction = 91.5_mm;
  Um cooling_tube_length = 5_mm;
  Um extra_loading_move = -2_mm;
  std::optional<int> material_standby_temperature;
  double machine_nozzle_heat_up_speed = 2;
  double machine_min_cool_heat_time_window = 50;
  std::optional<bool> prime_tower_enable;
  std::optional<Um> prime_tower_position_x;
  std::optional<Um> prime_tower_position_y;
  std::optional<Um> prime_tower_width;
  double prime_tower_angle = 0;
  Um prime_tower_brim_width = 2_mm;
  Um prime_tower_max_bridging_distance = 10_mm;
  double prime_tower_purge_width = 100;
  double prime_tower_purge_spacing = 100;
  double prime_tower_flare_angle = 30;
  TowerShape prime_tower_shape = TowerShape::plain;
  double prime_tower_cone_angle = 30;
  bool prime_tower_sparse = true;
  std::optional<int> prime_tower_extruder_nr;
  double prime_tower_min_volume = 15;
  std::optional<Numbers> purge_volumes;
  double purge_colour_tolerance = 2;
  double purge_mix_volume = 55.6;
  bool purge_into_infill = false;
  bool purge_into_object = false;
  std::optional<Numbers> gradient_tools;
  GradientAxis gradient_axis = GradientAxis::z;
  ValuesAt gradient_stops;
  GradientMode gradient_mode = GradientMode::lines;
  Um gradient_stripe_period = 4_mm;
  Um paint_depth = 3_mm;
  double colour_match = 20;
  bool prime_line = false;
  bool ooze_shield_enabled = false;
  Um ooze_shield_dist = 2_mm;
  HeightMarks pause_at_heights;
  HeightMarks color_change_at_heights;
  HeightMarks tool_change_at_heights;
  HeightMarks gcode_at_heights;
};

inline constexpr Rows tool_schema{
    setting("extruders_enabled_count", Scope::machine, &ToolSettings::extruders_enabled_count, Unit::none, 1, 32,
            "How many tools the printer has, T0 and so on; auto: as many as settings are given for."),
    setting("tool_settings", Scope::plate, &ToolSettings::tool_settings,
            "What other tools than T0 have otherwise: `1.material_flow = 97; 2.nozzle_diameter = 0.6`. A list between "
            "commas, a section [tool 1] and --tool 1=FILE say the same."),
    setting("tool_nozzles", Scope::tool, &ToolSettings::tool_nozzles, Unit::none, 0, 31,
            "The nozzle that the tool's filament is in: 0, 0, 0, 0 is one nozzle for four filaments; auto: its own."),
    setting("tool_select", Scope::machine, &ToolSettings::tool_select,
            "How a tool is chosen: firmware (ACTIVATE_EXTRUDER for Klipper, T for others), t (T1 for all of them), or "
            "swap (a pause in which the filament is changed by hand)."),
    setting("tool_order", Scope::plate, &ToolSettings::tool_order,
            "Order of the tools in a layer: least (purging and waiting over the whole print), fixed (by number), or "
            "cyclic (by number, from the one that is loaded)."),
    setting("tool_change_time", Scope::tool, &ToolSettings::tool_change_time, Unit::seconds, 0, 3600,
            "Time that a change to this tool takes, beside what is written."),
    setting("filament_colour", Scope::tool, &ToolSettings::filament_colour,
            "Colour of the filament, #RRGGBB: for purge volumes and pictures; auto: unknown."),
    setting("material_print_temperature_min", Scope::tool, &ToolSettings::material_print_temperature_min, Unit::celsius,
            0, 500, "Lowest temperature that the filament prints at; auto: unknown."),
    setting("material_print_temperature_max", Scope::tool, &ToolSettings::material_print_temperature_max, Unit::celsius,
            0, 500, "Highest temperature that the filament stands; auto: unknown."),
    setting(
        "material_soluble", Scope::tool, &ToolSettings::material_soluble,
        "Water or a solvent takes the filament away: nothing else of the part is made of it, nor of the tower's wall."),
    setting("material_nozzle_hardness", Scope::tool, &ToolSettings::material_nozzle_hardness, Unit::none, 0, 100,
            "Hardness (HRC) that a nozzle needs not to be worn out by the filament: 40 for carbon fibre; 0: any."),
    setting("machine_nozzle_hardness", Scope::tool, &ToolSettings::machine_nozzle_hardness, Unit::none, 0, 100,
            "Hardness (HRC) of the nozzle: brass 2, stainless steel 20, hardened steel 55; auto: unknown."),
    setting("machine_bed_plate", Scope::plate, &ToolSettings::machine_bed_plate,
            "The plate that lies on the bed, as material_plates call it; empty: not told."),
    setting("material_plates", Scope::tool, &ToolSettings::material_plates,
            "The plates that the filament holds on, between commas; empty: any."),
    setting("extruder_nr", Scope::region, &ToolSettings::extruder_nr, Unit::none, 0, 31,
            "The tool that an object or a part of it is printed with."),
    setting("wall_extruder_nr", Scope::region, &ToolSettings::wall_extruder_nr, Unit::none, 0, 31,
            "The tool of walls; auto is extruder_nr."),
    setting("wall_0_extruder_nr", Scope::region, &ToolSettings::wall_0_extruder_nr, Unit::none, 0, 31,
            "The tool of the outermost walls; auto is wall_extruder_nr."),
    setting("wall_x_extruder_nr", Scope::region, &ToolSettings::wall_x_extruder_nr, Unit::none, 0, 31,
            "The tool of the other walls; auto is wall_extruder_nr."),
    setting("infill_extruder_nr", Scope::region, &ToolSettings::infill_extruder_nr, Unit::none, 0, 31,
            "The tool of sparse infill; auto is extruder_nr."),
    setting("top_bottom_extruder_nr", Scope::region, &ToolSettings::top_bottom_extruder_nr, Unit::none, 0, 31,
            "The tool of tops, bottoms and bridges; auto is extruder_nr."),
    setting("roofing_extruder_nr", Scope::region, &ToolSettings::roofing_extruder_nr, Unit::none, 0, 31,
            "The tool of the topmost skin; auto is top_bottom_extruder_nr."),
    setting("adhesion_extruder_nr", Scope::plate, &ToolSettings::adhesion_extruder_nr, Unit::none, 0, 31,
            "The tool of skirt, brim and raft; auto: whichever is loaded."),
    setting("switch_extruder_retraction_amount", Scope::tool, &ToolSettings::switch_extruder_retraction_amount,
            Unit::mm, 0_mm, 200_mm, "Length of filament drawn back before another tool is loaded."),
    setting("switch_extruder_extra_prime_amount", Scope::tool, &ToolSettings::switch_extruder_extra_prime_amount,
            Unit::mm, -10_mm, 200_mm,
            "Length of filament pushed forward beyond that when the tool is loaded again: what oozed meanwhile."),
    setting(
        "filament_ramming_parameters", Scope::tool, &ToolSettings::filament_ramming_parameters,
        "Before the filament is drawn out of a shared nozzle its tip is shaped: width and spacing of lines in percent, "
        "then mm³/s, each for a quarter of a second: 120 100 6.6 6.8 7.2; empty: it is not."),
    setting("filament_multitool_ramming_volume", Scope::tool, &ToolSettings::filament_multitool_ramming_volume,
            Unit::mm3, 0, 1000,
            "Before a tool with a nozzle of its own is put away so much is laid on the tower, quickly: what has been "
            "hot for long is out, and less oozes; 0: nothing."),
    setting("filament_multitool_ramming_flow", Scope::tool, &ToolSettings::filament_multitool_ramming_flow, Unit::mm3_s,
            0.1, 200, "How fast that is laid."),
    setting("filament_unloading_speed_start", Scope::tool, &ToolSettings::filament_unloading_speed_start, Unit::mm_s,
            0.1, 500, "Speed of the first 15 mm that are drawn out."),
    setting("filament_unloading_speed", Scope::tool, &ToolSettings::filament_unloading_speed, Unit::mm_s, 0.1, 500,
            "Speed of what follows, as far as the cooling tube."),
    setting("filament_loading_speed_start", Scope::tool, &ToolSettings::filament_loading_speed_start, Unit::mm_s, 0.1,
            500, "Speed of the first fifth of what is pushed in."),
    setting("filament_loading_speed", Scope::tool, &ToolSettings::filament_loading_speed, Unit::mm_s, 0.1, 500,
            "Speed of what follows."),
    setting("filament_cooling_moves", Scope::tool, &ToolSettings::filament_cooling_moves, Unit::none, 0, 20,
            "How often the tip is moved to and fro in the cooling tube."),
    setting("filament_cooling_initial_speed", Scope::tool, &ToolSettings::filament_cooling_initial_speed, Unit::mm_s,
            0.1, 100, "Speed of the first of those moves."),
    setting("filament_cooling_final_speed", Scope::tool, &ToolSettings::filament_cooling_final_speed, Unit::mm_s, 0.1,
            100, "Speed of the last of them."),
    setting("filament_stamping_distance", Scope::tool, &ToolSettings::filament_stamping_distance, Unit::mm, 0_mm,
            1000_mm,
            "Between two cooling moves the tip is pushed so far beyond the middle of the tube, towards the nozzle, "
            "and drawn back: what strings is pressed into it; 0: it is not."),
    setting("filament_stamping_loading_speed", Scope::tool, &ToolSettings::filament_stamping_loading_speed, Unit::mm_s,
            0.1, 500, "Speed of that push; it is drawn back at filament_unloading_speed."),
    setting("filament_toolchange_delay", Scope::tool, &ToolSettings::filament_toolchange_delay, Unit::seconds, 0, 600,
            "How long is waited after the filament was drawn out."),
    setting("parking_pos_retraction", Scope::machine, &ToolSettings::parking_pos_retraction, Unit::mm, 0_mm, 2000_mm,
            "How far filament is drawn out of a shared nozzle before another comes; 0: the firmware does that."),
    setting("cooling_tube_retraction", Scope::machine, &ToolSettings::cooling_tube_retraction, Unit::mm, 0_mm, 1000_mm,
            "From the nozzle's tip to the middle of the tube that the filament's tip cools in."),
    setting("cooling_tube_length", Scope::machine, &ToolSettings::cooling_tube_length, Unit::mm, 0_mm, 1000_mm,
            "Length of that tube: how far the cooling moves go."),
    setting("extra_loading_move", Scope::machine, &ToolSettings::extra_loading_move, Unit::mm, -1000_mm, 1000_mm,
            "Pushed in beyond parking_pos_retraction; below 0: less."),
    setting("material_standby_temperature", Scope::tool, &ToolSettings::material_standby_temperature, Unit::celsius, 0,
            500,
            "Temperature of a nozzle whose tool waits for longer than machine_min_cool_heat_time_window; auto is 40 "
            "°C below material_print_temperature."),
    setting("machine_nozzle_heat_up_speed", Scope::tool, &ToolSettings::machine_nozzle_heat_up_speed, Unit::celsius_s,
            0.1, 50, "How fast the nozzle gets hotter: it is heated so long before its tool is loaded again."),
    setting("machine_min_cool_heat_time_window", Scope::tool, &ToolSettings::machine_min_cool_heat_time_window,
            Unit::seconds, 0, 100000, "A nozzle whose tool waits for less stays hot."),
    setting("prime_tower_enable", Scope::plate, &ToolSettings::prime_tower_enable,
            "Filament is purged into a tower at changes of the tool; auto: where filaments share a nozzle."),
    setting("prime_tower_position_x", Scope::plate, &ToolSettings::prime_tower_position_x, Unit::mm, -10000_mm,
            10000_mm, "The tower's front left corner, brim not included; auto: where there is room."),
    setting("prime_tower_position_y", Scope::plate, &ToolSettings::prime_tower_position_y, Unit::mm, -10000_mm,
            10000_mm, "The same in Y."),
    setting("prime_tower_width", Scope::plate, &ToolSettings::prime_tower_width, Unit::mm, 5_mm, 500_mm,
            "Width of the tower; its depth follows from what is purged; auto: about as wide as deep."),
    setting("prime_tower_angle", Scope::plate, &ToolSettings::prime_tower_angle, Unit::degrees, -360, 360,
            "The tower is turned about its corner, counter-clockwise."),
    setting("prime_tower_brim_width", Scope::plate, &ToolSettings::prime_tower_brim_width, Unit::mm, 0_mm, 50_mm,
            "How far the tower's first layer reaches beyond it."),
    setting("prime_tower_max_bridging_distance", Scope::plate, &ToolSettings::prime_tower_max_bridging_distance,
            Unit::mm, 1_mm, 50_mm, "Between the lines where a layer of the tower is not filled by purging."),
    setting("prime_tower_purge_width", Scope::plate, &ToolSettings::prime_tower_purge_width, Unit::percent, 100, 300,
            "Width of the lines that are purged, of what the tower's lines are wide (1.25 nozzles): fewer and fatter "
            "ones, quicker laid, on the same area."),
    setting("prime_tower_purge_spacing", Scope::plate, &ToolSettings::prime_tower_purge_spacing, Unit::percent, 100,
            300,
            "From one of those lines to the next, of their width; beyond 100 the tower is wider and cools better. The "
            "lowest section stays full."),
    setting("prime_tower_flare_angle", Scope::plate, &ToolSettings::prime_tower_flare_angle, Unit::degrees, 0, 60,
            "Below the first change the tower has nothing to hold but itself: it is as narrow there as it can stand, "
            "and gets wider at this angle from the vertical; 0: as wide at the bed as above. Only of a plain one."),
    setting("prime_tower_shape", Scope::plate, &ToolSettings::prime_tower_shape,
            "What the tower has beside its walls to stand by: plain, ribs at its corners, or a cone around its foot."),
    setting("prime_tower_cone_angle", Scope::plate, &ToolSettings::prime_tower_cone_angle, Unit::degrees, 0, 90,
            "Angle at the tip of that cone, which is as high as the tower."),
    setting("prime_tower_sparse", Scope::plate, &ToolSettings::prime_tower_sparse,
            "The tower keeps up with what is printed, in layers without a change too; off: it has only those with "
            "one, lies lower in the end, and the nozzle goes down to it, as far as the head has room."),
    setting(
        "prime_tower_extruder_nr", Scope::plate, &ToolSettings::prime_tower_extruder_nr, Unit::none, 0, 31,
        "The tool of the tower's wall, in layers that it prints in; auto: where filaments are of one kind, whichever "
        "purges most there, else that of most layers which is not soluble."),
    setting("prime_tower_min_volume", Scope::tool, &ToolSettings::prime_tower_min_volume, Unit::mm3, 0, 1000,
            "What is purged when this tool is loaded in a nozzle of its own, and the least in a shared one."),
    setting("purge_volumes", Scope::plate, &ToolSettings::purge_volumes,
            "mm³ to purge from each tool to each, a row for each that is unloaded: 0, 140, 140, 0 for two of them; "
            "auto: from filament_colour, 140 where that is unknown."),
    setting("purge_colour_tolerance", Scope::plate, &ToolSettings::purge_colour_tolerance, Unit::none, 0.5, 20,
            "Difference of colour (ΔE 1976) that purging by filament_colour may leave."),
    setting("purge_mix_volume", Scope::plate, &ToolSettings::purge_mix_volume, Unit::mm3, 1, 1000,
            "Volume in which what is left of the filament before falls to a share of 1/e: the melt zone of the hot "
            "end."),
    setting("purge_into_infill", Scope::object, &ToolSettings::purge_into_infill,
            "Sparse infill behind two walls is printed with what is purged; the rest goes into the tower."),
    setting("purge_into_object", Scope::object, &ToolSettings::purge_into_object,
            "All of the object is printed with what is purged, as far as that goes: its colours do not count."),
    setting("gradient_tools", Scope::object, &ToolSettings::gradient_tools,
            "Two tools that a gradient goes from and to: 0, 1; auto: none."),
    setting("gradient_axis", Scope::object, &ToolSettings::gradient_axis, "Along what it runs: x, y or z."),
    setting("gradient_stops", Scope::object, &ToolSettings::gradient_stops, Unit::none, -10000, 10000,
            "Share of the second tool at places, mm:%, even between them: 0:0, 30:100. Of x and y as on the bed."),
    setting("gradient_mode", Scope::object, &ToolSettings::gradient_mode,
            "How the share is made: lines (each of one of the two), stripes (across x or y), layers (in turn), or mix "
            "(in the nozzle: M163 or M567)."),
    setting("gradient_stripe_period", Scope::object, &ToolSettings::gradient_stripe_period, Unit::mm, 0.5_mm, 200_mm,
            "A stripe of the first tool and one of the second together."),
    setting("paint_depth", Scope::object, &ToolSettings::paint_depth, Unit::mm, 0.1_mm, 1000_mm,
            "How deep what is painted on a surface for another tool reaches into the part."),
    setting("colour_match", Scope::plate, &ToolSettings::colour_match, Unit::none, 0, 400,
            "A colour of a 3MF goes to the tool of the nearest filament_colour; one that differs by more than this "
            "(ΔE 1976) is told."),
    setting("prime_line", Scope::plate, &ToolSettings::prime_line,
            "Each tool that prints lays a line at the front of the bed first."),
    setting(
        "ooze_shield_enabled", Scope::plate, &ToolSettings::ooze_shield_enabled,
        "A wall around all objects, up to the last change of the tool, takes off what oozes from nozzles that wait."),
    setting("ooze_shield_dist", Scope::plate, &ToolSettings::ooze_shield_dist, Unit::mm, 0.5_mm, 30_mm,
            "Between that wall and the objects."),
    setting("pause_at_heights", Scope::plate, &ToolSettings::pause_at_heights,
            "Z at which the printer waits for somebody, with what to do: `5.2 = lay the nuts in; 10`. The layer that "
            "reaches above it is the first after."),
    setting("color_change_at_heights", Scope::plate, &ToolSettings::color_change_at_heights,
            "Z from which on other filament prints, which is changed by hand (M600): `2.4; 3 = white`."),
    setting("tool_change_at_heights", Scope::plate, &ToolSettings::tool_change_at_heights,
            "Z from which on everything is printed with one tool: `2.4 = 1; 3 = 0`."),
    setting("gcode_at_heights", Scope::plate, &ToolSettings::gcode_at_heights,
            "G-code before the first layer that reaches above a Z: `2.4 = M117 halfway`."),
};
static_assert(complete<ToolSettings>(tool_schema));

}  // namespace weft
