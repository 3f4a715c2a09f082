#include "settings/first_layer.h"

#include <algorithm>

namespace weft {
namespace {

void follow_widths(const Settings& s, Overlay& out) {
  const auto width = s.layers.initial_layer_line_width;
  if (!width) return;
  for (const auto* key :
       {"wall_line_width_0", "wall_line_width_x", "infill_line_width", "skin_line_width", "top_skin_line_width"})
    out.follow(key, width, "initial_layer_line_width");
}

/// Features are printed at speed_layer_0 where that is slower; a share of it is of the feature's own speed.
void follow_speeds(const Settings& settings, Overlay& out) {
  const auto& s = settings.speeds;
  const auto slower = [&](double speed) { return std::min(speed, s.speed_layer_0.of(speed)); };
  const auto follow = [&](std::string_view key, double speed) {
    if (slower(speed) != speed) out.follow(key, slower(speed), "speed_layer_0");
  };
  follow("speed_wall_0", s.speed_wall_0);
  follow("speed_wall_x", s.speed_wall_x);
  follow("speed_infill", s.speed_infill);
  follow("speed_topbottom", s.speed_topbottom);
  follow("speed_top_skin", s.speed_top_skin);
  follow("speed_bridge", s.speed_bridge);
  follow("speed_gap_fill", s.speed_gap_fill);
  // A share of speed_wall_0, which may be another now.
  if (const double overhang = s.speed_overhang.of(s.speed_wall_0);
      slower(overhang) != overhang || slower(s.speed_wall_0) != s.speed_wall_0)
    out.follow("speed_overhang", SpeedOrShare{slower(overhang), false}, "speed_layer_0");
  if (s.speed_travel_layer_0) out.follow("speed_travel", *s.speed_travel_layer_0, "speed_travel_layer_0");
}

/// Everything that is printed takes acceleration_layer_0; travels keep theirs.
void follow_accelerations(const Settings& settings, Overlay& out) {
  const auto& s = settings.speeds;
  if (!s.acceleration_layer_0 || !s.acceleration_enabled) return;
  out.follow("acceleration_travel", std::optional(s.acceleration_travel.value_or(s.acceleration_print)),
             "acceleration_print");
  for (const auto* key : {"acceleration_wall_0", "acceleration_wall_x", "acceleration_infill", "acceleration_topbottom",
                          "acceleration_top_skin", "acceleration_bridge"})
    out.follow(key, s.acceleration_layer_0, "acceleration_layer_0");
  out.follow("acceleration_print", *s.acceleration_layer_0, "acceleration_layer_0");
}

}  // namespace

Overlay first_layer_of(const Settings& s) {
  Overlay out{.what = "first layer", .scope = Scope::layer};
  if (s.layers.initial_layer_height) out.follow("layer_height", *s.layers.initial_layer_height, "initial_layer_height");
  follow_widths(s, out);
  if (s.walls.xy_offset_layer_0 != 0)
    out.follow("xy_offset", s.walls.xy_offset + s.walls.xy_offset_layer_0, "xy_offset_layer_0");
  follow_speeds(s, out);
  follow_accelerations(s, out);
  const auto& m = s.material;
  if (m.material_print_temperature_layer_0)
    out.follow("material_print_temperature", *m.material_print_temperature_layer_0,
               "material_print_temperature_layer_0");
  if (m.material_bed_temperature_layer_0)
    out.follow("material_bed_temperature", *m.material_bed_temperature_layer_0, "material_bed_temperature_layer_0");
  return out;
}

Settings on_first_layer(Settings settings) {
  lay(settings, first_layer_of(settings));
  return settings;
}

}  // namespace weft
