// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <string_view>

/// Keys that PrusaSlicer has renamed.
namespace weft::prusaslicer {

/// The key's name today; old names are still found in profiles.
struct Renamed {
  std::string_view then, now;
};
inline constexpr std::array renamed{
    Renamed{"octoprint_host", "print_host"},
    Renamed{"octoprint_apikey", "printhost_apikey"},
    Renamed{"octoprint_cafile", "printhost_cafile"},
};
constexpr std::string_view current_name(std::string_view key) {
  for (const auto& row : renamed)
    if (row.then == key) return row.now;
  return key;
}

/// One key then, several today.
inline constexpr std::array shortcuts{
    Renamed{"external_fill_pattern", "top_fill_pattern"},
    Renamed{"external_fill_pattern", "bottom_fill_pattern"},
    Renamed{"solid_fill_pattern", "top_fill_pattern"},
    Renamed{"solid_fill_pattern", "bottom_fill_pattern"},
    Renamed{"solid_layers", "top_solid_layers"},
    Renamed{"solid_layers", "bottom_solid_layers"},
    Renamed{"solid_min_thickness", "top_solid_min_thickness"},
    Renamed{"solid_min_thickness", "bottom_solid_min_thickness"},
};

}  // namespace weft::prusaslicer
