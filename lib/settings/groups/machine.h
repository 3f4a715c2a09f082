// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/schema.h"

#include <array>

namespace weft {
using namespace weft::literals;

enum class BedShape { rectangle, circle, polygon };
constexpr auto choices_of(BedShape) {
  return std::array{Choice<BedShape>{BedShape::rectangle, "rectangle"}, Choice<BedShape>{BedShape::circle, "circle"},
                    Choice<BedShape>{BedShape::polygon, "polygon"}};
}

/// The firmware that will read the file.
enum class Firmware { marlin, marlin2, klipper, reprapfirmware, repetier, smoothie };
constexpr auto choices_of(Firmware) {
  return std::array{
      Choice<Firmware>{Firmware::marlin, "marlin"},     Choice<Firmware>{Firmware::marlin2, "marlin2"},
      Choice<Firmware>{Firmware::klipper, "klipper"},   Choice<Firmware>{Firmware::reprapfirmware, "reprapfirmware"},
      Choice<Firmware>{Firmware::repetier, "repetier"}, Choice<Firmware>{Firmware::smoothie, "smoothie"}};
}

/// The printer: what it can reach, its nozzle, its limits.
struct MachineSettings {
  std::string machine_name;
  double machine_hourly_cost = 0;
  std::string currency;
  BedShape bed_shape = BedShape::rectangle;
  Um machine_width = 220_mm;
  Um machine_depth = 220_mm;
  Um machine_height = 250_mm;  ///< 0: no limit; see height_of
  bool machine_center_is_zero = false;
  Ring bed_polygon;
  std::vector<Ring> bed_exclude_areas;
  std::optional<Um> exclude_height;
  Ring machine_reach;
  Um machine_reach_z_min = 0_mm;
  std::optional<Um> machine_reach_z_max;
  std::optional<Ring> home_position;
  std::optional<Um> home_z;
  std::optional<Ring> macro_position;
  std::optional<Um> macro_z;
  Ring nozzle_offsets;
  Um z_offset = 0_mm;
  Um nozzle_diameter = 0.4_mm;
  Um machine_nozzle_tip_outer_diameter = 1_mm;
  Firmware firmware = Firmware::marlin2;
  double machine_max_speed_x = 300;
  double machine_max_speed_y = 300;
  double machine_max_speed_z = 10;
  double machine_max_speed_e = 60;
  double machine_max_acceleration_x = 3000;
  double machine_max_acceleration_y = 3000;
  double machine_max_acceleration_z = 100;
  double machine_max_acceleration_e = 5000;
  std::optional<double> machine_junction_deviation;
  double machine_max_jerk = 8;
  double machine_max_jerk_z = 0.4;
  std::optional<double> machine_max_jerk_e;
  double machine_minimum_cruise_ratio = 50;
  std::optional<int> machine_planner_blocks;
  Numbers machine_silent_limits;
};

inline constexpr Rows machine_schema{
    setting("machine_name", Scope::machine, &MachineSettings::machine_name,
            "Name of the printer, for comments and messages."),
    setting("machine_hourly_cost", Scope::machine, &MachineSettings::machine_hourly_cost, Unit::per_h, 0, 1'000'000,
            "What an hour of printing costs, in `currency`, for the cost in report and footer; 0: not reckoned."),
    setting("currency", Scope::machine, &MachineSettings::currency, "What prices are in, for reports: EUR, $, points."),
    setting("bed_shape", Scope::machine, &MachineSettings::bed_shape, "Shape of the print surface."),
    setting("machine_width", Scope::machine, &MachineSettings::machine_width, Unit::mm, 1_mm, 10000_mm,
            "Extent of the print surface along X."),
    setting("machine_depth", Scope::machine, &MachineSettings::machine_depth, Unit::mm, 1_mm, 10000_mm,
            "Extent of the print surface along Y."),
    setting("machine_height", Scope::machine, &MachineSettings::machine_height, Unit::mm, 0_mm, 10000_mm,
            "Highest Z that may be printed at; 0: unlimited."),
    setting("machine_center_is_zero", Scope::machine, &MachineSettings::machine_center_is_zero,
            "The origin is the centre of the print surface, not its front left corner."),
    setting("bed_polygon", Scope::machine, &MachineSettings::bed_polygon,
            "Corners of the print surface when bed_shape is polygon."),
    setting("bed_exclude_areas", Scope::machine, &MachineSettings::bed_exclude_areas,
            "Areas that no move may enter below exclude_height: polygons separated by ';'."),
    setting("exclude_height", Scope::machine, &MachineSettings::exclude_height, Unit::mm, 0_mm, 10000_mm,
            "Z up to which bed_exclude_areas hold; auto is machine_height."),
    setting(
        "machine_reach", Scope::machine, &MachineSettings::machine_reach,
        "Corners of the area that the nozzle can go to, two opposite ones or a polygon; empty is the print surface."),
    setting("machine_reach_z_min", Scope::machine, &MachineSettings::machine_reach_z_min, Unit::mm, -1000_mm, 1000_mm,
            "Lowest Z that the nozzle can go to."),
    setting("machine_reach_z_max", Scope::machine, &MachineSettings::machine_reach_z_max, Unit::mm, 1_mm, 10000_mm,
            "Highest Z that the nozzle can go to; auto is machine_height."),
    setting("home_position", Scope::machine, &MachineSettings::home_position,
            "Where G28 leaves the nozzle, one point; auto: unknown."),
    setting("home_z", Scope::machine, &MachineSettings::home_z, Unit::mm, -1000_mm, 10000_mm,
            "Height at which G28 leaves the nozzle; auto: unknown."),
    setting("macro_position", Scope::machine, &MachineSettings::macro_position,
            "Where the printer's own macros (PRINT_START, a tool change) leave the nozzle, one point; auto: unknown."),
    setting("macro_z", Scope::machine, &MachineSettings::macro_z, Unit::mm, -1000_mm, 10000_mm,
            "Height at which the printer's own macros leave the nozzle; auto: unknown."),
    setting(
        "nozzle_offsets", Scope::tool, &MachineSettings::nozzle_offsets,
        "Where each nozzle stands from the first, in order of tool number, when the firmware does not allow for it."),
    setting("z_offset", Scope::machine, &MachineSettings::z_offset, Unit::mm, -10_mm, 10_mm,
            "Added to every Z that is written: positive lifts the nozzle, where the end stop lets it sit too low."),
    setting("nozzle_diameter", Scope::tool, &MachineSettings::nozzle_diameter, Unit::mm, 0.05_mm, 5_mm,
            "Diameter of the nozzle's opening."),
    setting("machine_nozzle_tip_outer_diameter", Scope::tool, &MachineSettings::machine_nozzle_tip_outer_diameter,
            Unit::mm, 0.1_mm, 10_mm, "Diameter of the flat that the nozzle ends in, which digs into slopes uphill."),
    setting("firmware", Scope::machine, &MachineSettings::firmware,
            "The firmware that reads the file; marlin is Marlin 1 and what descends from it."),
    setting("machine_max_speed_x", Scope::machine, &MachineSettings::machine_max_speed_x, Unit::mm_s, 1, 5000,
            "Speed limit of X."),
    setting("machine_max_speed_y", Scope::machine, &MachineSettings::machine_max_speed_y, Unit::mm_s, 1, 5000,
            "Speed limit of Y."),
    setting("machine_max_speed_z", Scope::machine, &MachineSettings::machine_max_speed_z, Unit::mm_s, 0.1, 5000,
            "Speed limit of Z."),
    setting("machine_max_speed_e", Scope::machine, &MachineSettings::machine_max_speed_e, Unit::mm_s, 0.1, 5000,
            "Speed limit of the extruder."),
    setting("machine_max_acceleration_x", Scope::machine, &MachineSettings::machine_max_acceleration_x, Unit::mm_s2, 1,
            100000, "Acceleration limit of X."),
    setting("machine_max_acceleration_y", Scope::machine, &MachineSettings::machine_max_acceleration_y, Unit::mm_s2, 1,
            100000, "Acceleration limit of Y."),
    setting("machine_max_acceleration_z", Scope::machine, &MachineSettings::machine_max_acceleration_z, Unit::mm_s2, 1,
            100000, "Acceleration limit of Z."),
    setting("machine_max_acceleration_e", Scope::machine, &MachineSettings::machine_max_acceleration_e, Unit::mm_s2, 1,
            100000, "Acceleration limit of the extruder."),
    setting("machine_junction_deviation", Scope::machine, &MachineSettings::machine_junction_deviation, Unit::mm, 0.001,
            1, "Junction deviation of the planner; auto: the planner uses machine_max_jerk."),
    setting("machine_max_jerk", Scope::machine, &MachineSettings::machine_max_jerk, Unit::mm_s, 0.1, 200,
            "Speed at which X and Y may change in a corner (Marlin's jerk, Klipper's square corner velocity)."),
    setting("machine_max_jerk_z", Scope::machine, &MachineSettings::machine_max_jerk_z, Unit::mm_s, 0.01, 200,
            "Speed at which Z may change at once; Klipper knows none."),
    setting(
        "machine_max_jerk_e", Scope::machine, &MachineSettings::machine_max_jerk_e, Unit::mm_s, 0.01, 200,
        "Speed at which the filament's may change at once (Klipper's instantaneous_corner_velocity); auto is 5, with "
        "Klipper 1."),
    setting(
        "machine_minimum_cruise_ratio", Scope::machine, &MachineSettings::machine_minimum_cruise_ratio, Unit::percent,
        0, 99,
        "Share of short zigzags that Klipper does not speed up along (its minimum_cruise_ratio), for the estimate of "
        "time."),
    setting("machine_planner_blocks", Scope::machine, &MachineSettings::machine_planner_blocks, Unit::none, 2, 10000,
            "Moves that the firmware looks ahead over, for the estimate of time; auto is 16 with Marlin, Repetier and "
            "Smoothie, and all with Klipper and RepRapFirmware."),
    setting(
        "machine_silent_limits", Scope::machine, &MachineSettings::machine_silent_limits, Unit::none, 0.01, 100000,
        "Limits of the firmware's silent mode, whose times M73 tells beside the usual ones: eleven numbers, the speeds "
        "of X, Y, Z, E, their accelerations, jerk of X and Y, of Z and of E; empty: it has none."),
};
static_assert(complete<MachineSettings>(machine_schema));

/// The print surface, counter-clockwise. A circle of diameter machine_width becomes an inscribed polygon that stands
/// off it by at most tolerances::arc. Pre: a consistent machine (profile/profile.h).
Ring print_surface(const MachineSettings& machine);

/// The area that the nozzle can go to, counter-clockwise: machine_reach, or the print surface where that is empty.
Ring reach_area(const MachineSettings& machine);

/// Highest Z that may be printed at.
inline Um height_of(const MachineSettings& machine) {
  return machine.machine_height == 0 ? max_coord : machine.machine_height;
}

/// Highest Z that the nozzle can go to, and Z up to which bed_exclude_areas hold.
inline Um reach_z_max(const MachineSettings& machine) {
  return machine.machine_reach_z_max.value_or(height_of(machine));
}
inline Um exclude_height(const MachineSettings& machine) {
  return machine.exclude_height.value_or(height_of(machine));
}

/// Numbers that machine_silent_limits has.
inline constexpr std::size_t silent_limits = 11;

/// The machine in its silent mode; nothing: it has none, or not all of its limits are known.
std::optional<MachineSettings> in_silent_mode(const MachineSettings& machine);

/// Do no two edges of the ring cross, touch or overlap, but for neighbours at their common corner? Exact. O(n²).
bool is_simple(const Ring& ring);

}  // namespace weft
