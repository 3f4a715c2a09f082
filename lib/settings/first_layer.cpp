// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/first_layer.h"

#include <algorithm>
#include <optional>
#include <string_view>
#include <type_traits>

namespace weft {
namespace {

void follow_widths(const Settings& s, Overlay& out) {
  const auto width = s.layers.initial_layer_line_width;
  if (!width) return;
  for (const auto* key :
       {"wall_line_width_0", "wall_line_width_x", "infill_line_width", "skin_line_width", "top_skin_line_width"})
    out.follow(key, width, "initial_layer_line_width");
}

/// Calls `see` with each row of speeds of that type and unit.
template <class T, class See>
void for_rows_of(Unit unit, const See& see) {
  const auto look = [&](const auto& row) {
    if constexpr (std::is_same_v<decltype(row.field), T SpeedSettings::*>)
      if (row.unit == unit) see(row);
  };
  speed_schema.for_each(look);
}

/// A key, and its value.
template <class T>
struct Named {
  const char* key;
  T value;
};

/// Features are printed at that speed where it is slower; a share of it is of the feature's own speed. Every speed is a
/// feature's but those of ways without plastic.
void follow_speeds(const SpeedSettings& s, const Named<SpeedOrShare>& most, Overlay& out) {
  const auto slower = [&](double speed) { return std::min(speed, most.value.of(speed)); };
  for_rows_of<double>(Unit::mm_s, [&](const auto& row) {
    if (row.field == &SpeedSettings::speed_travel || row.field == &SpeedSettings::speed_z_hop) return;
    if (const double speed = s.*(row.field); slower(speed) != speed) out.follow(row.key, slower(speed), most.key);
  });
  // A share of speed_wall_0, which may be another now. Those by the width over air are of no first layer.
  if (const double overhang = s.speed_overhang.of(s.speed_wall_0);
      slower(overhang) != overhang || slower(s.speed_wall_0) != s.speed_wall_0)
    out.follow("speed_overhang", SpeedOrShare{slower(overhang), false}, most.key);
}

/// Everything that is printed takes that acceleration; travels keep theirs.
void follow_accelerations(const SpeedSettings& s, const Named<std::optional<double>>& all, Overlay& out) {
  if (!all.value || !s.acceleration_enabled) return;
  out.follow("acceleration_travel", std::optional(s.acceleration_travel.value_or(s.acceleration_print)),
             "acceleration_print");
  for_rows_of<std::optional<double>>(Unit::mm_s2, [&](const auto& row) {
    if (row.field != &SpeedSettings::acceleration_travel && row.field != &SpeedSettings::acceleration_layer_0)
      out.follow(row.key, all.value, all.key);
  });
  out.follow("acceleration_print", *all.value, all.key);
}

}  // namespace

Overlay first_layer_of(const Settings& s) {
  Overlay out{.what = "first layer", .scope = Scope::layer};
  if (s.layers.initial_layer_height) out.follow("layer_height", *s.layers.initial_layer_height, "initial_layer_height");
  follow_widths(s, out);
  if (s.walls.xy_offset_layer_0 != 0)
    out.follow("xy_offset", s.walls.xy_offset + s.walls.xy_offset_layer_0, "xy_offset_layer_0");
  follow_speeds(s.speeds, {"speed_layer_0", s.speeds.speed_layer_0}, out);
  if (const auto solid = s.speeds.speed_topbottom_layer_0)
    out.follow("speed_topbottom", *solid, "speed_topbottom_layer_0");
  if (const auto travel = s.speeds.speed_travel_layer_0) out.follow("speed_travel", *travel, "speed_travel_layer_0");
  follow_accelerations(s.speeds, {"acceleration_layer_0", s.speeds.acceleration_layer_0}, out);
  const auto& m = s.material;
  if (m.material_print_temperature_layer_0)
    out.follow("material_print_temperature", *m.material_print_temperature_layer_0,
               "material_print_temperature_layer_0");
  if (m.material_bed_temperature_layer_0)
    out.follow("material_bed_temperature", *m.material_bed_temperature_layer_0, "material_bed_temperature_layer_0");
  return out;
}

Overlay first_layer_on_raft_of(const Settings& s) {
  Overlay out{.what = "first layer on a raft", .scope = Scope::layer};
  follow_speeds(s.speeds, {"speed_layer_0_over_raft", s.raft.speed_layer_0_over_raft.value_or(s.speeds.speed_layer_0)},
                out);
  follow_accelerations(s.speeds, {"acceleration_layer_0_over_raft", s.raft.acceleration_layer_0_over_raft}, out);
  return out;
}

Settings on_first_layer(Settings settings) {
  lay(settings, first_layer_of(settings));
  return settings;
}

}  // namespace weft
