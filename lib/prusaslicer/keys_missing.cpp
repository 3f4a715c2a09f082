// SPDX-License-Identifier: GPL-3.0-or-later
#include "prusaslicer/keys.h"

#include <array>

namespace weft::prusaslicer {
namespace {

// to_array: deducing the size of a std::array folds over its elements, and clang ends at 256.
constexpr auto rows = std::to_array<Key>({
    Key{.name = "extruder", .neutral = "1|0", .fate = "only for printers of several extruders"},
    Key{.name = "perimeter_extruder",
        .neutral = "1|0",
        .fate = "only for printers of several extruders",
        .initial = "1"},
    Key{.name = "infill_extruder", .neutral = "1|0", .fate = "only for printers of several extruders", .initial = "1"},
    Key{.name = "solid_infill_extruder",
        .neutral = "1|0",
        .fate = "only for printers of several extruders",
        .initial = "1"},
    Key{.name = "support_material_extruder",
        .neutral = "1|0",
        .fate = "only for printers of several extruders",
        .initial = "1"},
    Key{.name = "support_material_interface_extruder",
        .neutral = "1|0",
        .fate = "only for printers of several extruders",
        .initial = "1"},
    Key{.name = "ooze_prevention",
        .neutral = "0",
        .fate = "not supported yet",
        .written = Written::flag,
        .initial = "0"},
    Key{.name = "over_bridge_speed", .neutral = "0", .fate = "not supported yet", .initial = "0"},
    Key{.name = "travel_short_distance_acceleration", .neutral = "0", .fate = "not supported yet", .initial = "0"},
    Key{.name = "extra_perimeters_on_overhangs",
        .neutral = "0",
        .fate = "not supported yet",
        .written = Written::flag,
        .initial = "0"},
    Key{.name = "avoid_crossing_curled_overhangs",
        .neutral = "0",
        .fate = "not supported yet",
        .written = Written::flag,
        .initial = "0"},
});

}  // namespace

std::span<const Key> missing_keys() {
  return rows;
}

}  // namespace weft::prusaslicer
