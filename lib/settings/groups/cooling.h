// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/schema.h"

namespace weft {

/// The part-cooling fan, and time for a layer to set.
struct CoolingSettings {
  bool cool_fan_enabled = true;
  bool cool_fan_always_on = true;
  double cool_fan_speed_min = 60;
  double cool_fan_speed_max = 100;
  double cool_fan_speed_0 = 0;
  int cool_fan_off_layers = 1;
  int cool_fan_full_layer = 4;
  double cool_fan_lead = 0;
  double bridge_fan_speed = 100;
  std::optional<double> overhang_fan_speed_25;
  std::optional<double> overhang_fan_speed_50;
  std::optional<double> overhang_fan_speed_75;
  std::optional<double> overhang_fan_speed_100;
  bool support_fan_enable = false;
  double support_supported_skin_fan_speed = 100;
  std::optional<double> support_interface_fan_speed;
  double cool_min_layer_time_fan_speed_max = 30;
  double cool_min_layer_time = 5;
  double cool_min_speed = 10;
};

inline constexpr Rows cooling_schema{
    setting("cool_fan_enabled", Scope::layer, &CoolingSettings::cool_fan_enabled,
            "The part-cooling fan is used at all."),
    setting("cool_fan_always_on", Scope::layer, &CoolingSettings::cool_fan_always_on,
            "The fan runs at cool_fan_speed_min also in layers that take long; off: it stands still there."),
    setting("cool_fan_speed_min", Scope::layer, &CoolingSettings::cool_fan_speed_min, Unit::percent, 0, 100,
            "Fan in layers that take cool_min_layer_time_fan_speed_max or longer."),
    setting("cool_fan_speed_max", Scope::layer, &CoolingSettings::cool_fan_speed_max, Unit::percent, 0, 100,
            "Fan in layers that take no longer than cool_min_layer_time; in between it is interpolated."),
    setting("cool_fan_speed_0", Scope::layer, &CoolingSettings::cool_fan_speed_0, Unit::percent, 0, 100,
            "Fan in the first cool_fan_off_layers layers."),
    setting("cool_fan_off_layers", Scope::layer, &CoolingSettings::cool_fan_off_layers, Unit::layers, 0, 1000000,
            "First layers with the fan at cool_fan_speed_0, so that they stick."),
    setting("cool_fan_full_layer", Scope::layer, &CoolingSettings::cool_fan_full_layer, Unit::layers, 0, 1000000,
            "Number of the layer, counted from 1, up to which the fan is raised step by step."),
    setting("cool_fan_lead", Scope::layer, &CoolingSettings::cool_fan_lead, Unit::seconds, 0, 5,
            "How long before a bead a fan that is to turn faster for it is told so: as long as it takes to speed up."),
    setting("bridge_fan_speed", Scope::region, &CoolingSettings::bridge_fan_speed, Unit::percent, 0, 100,
            "Fan over bridges and walls over air, where it is more than the layer's."),
    setting("overhang_fan_speed_25", Scope::region, &CoolingSettings::overhang_fan_speed_25, Unit::percent, 0, 100,
            "Fan over walls that lie over air with a tenth to a quarter of their width, where it is more than the "
            "layer's; auto: the layer's."),
    setting("overhang_fan_speed_50", Scope::region, &CoolingSettings::overhang_fan_speed_50, Unit::percent, 0, 100,
            "The same with a quarter to a half of their width."),
    setting("overhang_fan_speed_75", Scope::region, &CoolingSettings::overhang_fan_speed_75, Unit::percent, 0, 100,
            "The same with a half to three quarters of their width; auto: bridge_fan_speed."),
    setting("overhang_fan_speed_100", Scope::region, &CoolingSettings::overhang_fan_speed_100, Unit::percent, 0, 100,
            "The same with more than three quarters of their width; auto: bridge_fan_speed, which holds where all of "
            "it lies over air."),
    setting("support_fan_enable", Scope::region, &CoolingSettings::support_fan_enable,
            "Skin that lies on support has a fan of its own, so that it does not weld to it."),
    setting("support_supported_skin_fan_speed", Scope::region, &CoolingSettings::support_supported_skin_fan_speed,
            Unit::percent, 0, 100, "That fan."),
    setting("support_interface_fan_speed", Scope::region, &CoolingSettings::support_interface_fan_speed, Unit::percent,
            0, 100, "Fan over interfaces of support; auto: the layer's."),
    setting("cool_min_layer_time_fan_speed_max", Scope::layer, &CoolingSettings::cool_min_layer_time_fan_speed_max,
            Unit::seconds, 0, 3600, "Layers faster than this get more than cool_fan_speed_min."),
    setting("cool_min_layer_time", Scope::layer, &CoolingSettings::cool_min_layer_time, Unit::seconds, 0, 3600,
            "A layer takes at least so long: its printing is slowed down."),
    setting("cool_min_speed", Scope::layer, &CoolingSettings::cool_min_speed, Unit::mm_s, 0.1, 5000,
            "Slowing down for cool_min_layer_time ends here."),
};
static_assert(complete<CoolingSettings>(cooling_schema));

}  // namespace weft
