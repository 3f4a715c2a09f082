// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/schema.h"

namespace weft {
using namespace weft::literals;

/// The filament: what it is, how hot, how fast it melts.
struct MaterialSettings {
  std::string material_type = "PLA";
  Um filament_diameter = 1.75_mm;
  double material_density = 1.24;
  double filament_cost = 0;
  double material_flow = 100;
  double material_shrinkage_percentage_xy = 100;
  double material_shrinkage_percentage_z = 100;
  double material_max_volumetric_speed = 12;
  PressureRows pressure_advance_model;
  double pressure_advance_step = 0.004;
  int material_print_temperature = 210;
  std::optional<int> material_print_temperature_layer_0;
  int material_bed_temperature = 60;
  std::optional<int> material_bed_temperature_layer_0;
  int build_volume_temperature = 0;
  std::optional<int> build_volume_wait_temperature;
  bool material_print_temp_wait = true;
  bool material_bed_temp_wait = true;
};

inline constexpr Rows material_schema{
    setting("material_type", Scope::tool, &MaterialSettings::material_type,
            "Kind of plastic, for comments and messages."),
    setting("filament_diameter", Scope::tool, &MaterialSettings::filament_diameter, Unit::mm, 0.5_mm, 5_mm,
            "Diameter of the filament."),
    setting("material_density", Scope::tool, &MaterialSettings::material_density, Unit::g_cm3, 0.1, 20,
            "Density, for the weight in the report."),
    setting(
        "filament_cost", Scope::tool, &MaterialSettings::filament_cost, Unit::per_kg, 0, 1'000'000,
        "What a kilogram of the filament costs, in `currency`, for the cost in report and footer; 0: not reckoned."),
    setting("material_flow", Scope::tool, &MaterialSettings::material_flow, Unit::percent, 1, 300,
            "Multiplies every extrusion."),
    setting("material_shrinkage_percentage_xy", Scope::plate, &MaterialSettings::material_shrinkage_percentage_xy,
            Unit::percent, 50, 200,
            "Models are printed at this share of their size in X and Y, for a plastic that shrinks as it cools."),
    setting("material_shrinkage_percentage_z", Scope::plate, &MaterialSettings::material_shrinkage_percentage_z,
            Unit::percent, 50, 200, "The same in Z."),
    setting("material_max_volumetric_speed", Scope::tool, &MaterialSettings::material_max_volumetric_speed, Unit::mm3_s,
            0.1, 500, "What the hot end melts; speeds are lowered to stay below it."),
    setting("pressure_advance_model", Scope::tool, &MaterialSettings::pressure_advance_model,
            "Pressure advance by flow and acceleration, as measured: `0.04, 3, 1000; 0.03, 10, 1000`, each row an "
            "advance in s, mm³/s, mm/s², and perhaps the height of a layer in mm; empty: the firmware's own stays."),
    setting("pressure_advance_step", Scope::tool, &MaterialSettings::pressure_advance_step, Unit::seconds, 0.0001, 0.1,
            "Pressure advance is told anew where it differs by this or more."),
    setting("material_print_temperature", Scope::tool, &MaterialSettings::material_print_temperature, Unit::celsius, 0,
            500, "Nozzle temperature."),
    setting("material_print_temperature_layer_0", Scope::tool, &MaterialSettings::material_print_temperature_layer_0,
            Unit::celsius, 0, 500, "Nozzle temperature of the first layer; auto is material_print_temperature."),
    setting("material_bed_temperature", Scope::tool, &MaterialSettings::material_bed_temperature, Unit::celsius, 0, 200,
            "Bed temperature; 0 leaves the bed alone. Of several tools that of the first one of the print counts."),
    setting("material_bed_temperature_layer_0", Scope::tool, &MaterialSettings::material_bed_temperature_layer_0,
            Unit::celsius, 0, 200, "Bed temperature of the first layer; auto is material_bed_temperature."),
    setting("build_volume_temperature", Scope::plate, &MaterialSettings::build_volume_temperature, Unit::celsius, 0,
            200, "Temperature of the chamber; 0 leaves it alone."),
    setting("build_volume_wait_temperature", Scope::plate, &MaterialSettings::build_volume_wait_temperature,
            Unit::celsius, 0, 200,
            "The start G-code begins when the chamber is as warm as this (M191), and goes on heating; 0 does not wait, "
            "auto is build_volume_temperature."),
    setting("material_print_temp_wait", Scope::plate, &MaterialSettings::material_print_temp_wait,
            "The print begins when the nozzle is hot (M109); off: it is only told to heat (M104)."),
    setting("material_bed_temp_wait", Scope::plate, &MaterialSettings::material_bed_temp_wait,
            "The start G-code begins when bed and chamber are warm (M190, M191); off: they are only told to heat "
            "(M140, M141)."),
};
static_assert(complete<MaterialSettings>(material_schema));

}  // namespace weft
