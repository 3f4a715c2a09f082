// SPDX-License-Identifier: GPL-3.0-or-later
#include "prusaslicer/overhangs.h"

#include "settings/value.h"

#include <array>

namespace weft::prusaslicer {
namespace {

using value::number;

struct Band {
  std::string_view speed, fan;            ///< PrusaSlicer's, by what lies on the layer below
  std::string_view speed_ours, fan_ours;  ///< by what does not
};
constexpr std::array bands{
    Band{"overhang_speed_0", "overhang_fan_speed_0", "speed_overhang_100", "overhang_fan_speed_100"},
    Band{"overhang_speed_1", "overhang_fan_speed_1", "speed_overhang_75", "overhang_fan_speed_75"},
    Band{"overhang_speed_2", "overhang_fan_speed_2", "speed_overhang_50", "overhang_fan_speed_50"},
    Band{"overhang_speed_3", "overhang_fan_speed_3", "speed_overhang_25", "overhang_fan_speed_25"},
};

void add_speeds(Lines& lines, double bridge_mm_s, std::vector<Told>& out) {
  const auto *walls = lines.find("overhangs"), *dynamic = lines.find("enable_dynamic_overhang_speeds");
  const bool by_share = dynamic && lines.flag(*dynamic);
  const auto* line = walls ? walls : dynamic;
  if (walls) out.push_back({"overhang_walls", lines.flag(*walls) ? "true" : "false", walls});
  const auto speed_of = [&](std::string_view key) -> std::string {
    const auto* e = lines.find(key);
    if (!e) return "100%";
    const auto f = lines.figure(*e);
    return f.v == 0 ? "100%" : number(f.v) + (f.percent ? "%" : "");
  };
  for (const auto& band : bands) {
    const auto text = speed_of(band.speed);
    if (line) out.push_back({band.speed_ours, by_share ? text : "100%", by_share ? dynamic : line});
  }
  if (by_share)
    out.push_back({"speed_overhang", speed_of(bands[0].speed), dynamic});
  else if (const auto* bridge = lines.look("bridge_speed"))
    out.push_back({"speed_overhang", number(bridge_mm_s), bridge});
}

void add_fans(Lines& lines, std::vector<Told>& out) {
  const auto* dynamic = lines.find("enable_dynamic_fan_speeds");
  const bool by_share = dynamic && lines.flag(*dynamic);
  for (const auto& band : bands) {
    const auto* e = lines.find(band.fan);
    // A fan that is never more than the layer's: walls that lie on the layer below in part have none of their own.
    if (dynamic) out.push_back({band.fan_ours, by_share && e ? number(lines.figure(*e).v) : "0", dynamic});
  }
}

}  // namespace

std::vector<Told> overhangs_of(Lines& lines, double bridge_mm_s) {
  std::vector<Told> out;
  add_speeds(lines, bridge_mm_s, out);
  add_fans(lines, out);
  return out;
}

}  // namespace weft::prusaslicer
