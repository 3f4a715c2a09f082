// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/schema.h"

#include <array>

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
  double prime_tower_min_volume = 15;
  std::optional<Numbers> purge_volumes;
  double purge_colour_tolerance = 2;
  double purge_mix_volume = 55.6;
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
