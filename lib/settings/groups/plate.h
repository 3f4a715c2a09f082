// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/schema.h"

#include <array>
#include <optional>
#include <string>

namespace weft {
using namespace weft::literals;

/// In which order the objects of a plate are printed.
enum class PrintSequence { all_at_once, one_at_a_time };
constexpr auto choices_of(PrintSequence) {
  return std::array{Choice<PrintSequence>{PrintSequence::all_at_once, "all_at_once"},
                    Choice<PrintSequence>{PrintSequence::one_at_a_time, "one_at_a_time"}};
}

/// Along which axis the bar that carries the head spans the bed.
enum class GantryAxis { x, y };
constexpr auto choices_of(GantryAxis) {
  return std::array{Choice<GantryAxis>{GantryAxis::x, "x"}, Choice<GantryAxis>{GantryAxis::y, "y"}};
}

/// What objects on one plate are to each other.
struct PlateSettings {
  PrintSequence print_sequence = PrintSequence::all_at_once;
  std::string machine_head_profile;  ///< see settings/head_profile.h
  std::optional<Um> gantry_height;
  GantryAxis gantry_axis = GantryAxis::x;
  Um conflict_tolerance = 0.1_mm;
};

inline constexpr Rows plate_schema{
    setting("print_sequence", Scope::plate, &PlateSettings::print_sequence,
            "Objects are printed all at once, layer by layer, or one_at_a_time, each finished before the next begins; "
            "an order in which the head meets none of them is found (machine_head_profile, gantry_height)."),
    setting("machine_head_profile", Scope::machine, &PlateSettings::machine_head_profile,
            "The head above the nozzle's tip: from each height on, in mm, a polygon around the nozzle: "
            "`0: -10x-10, 10x-10, 10x10, -10x10; 12: -30x-25, 45x-25, 45x60, -30x60`. One at a time needs it."),
    setting("gantry_height", Scope::machine, &PlateSettings::gantry_height, Unit::mm, 0_mm, 1000_mm,
            "Height above the nozzle's tip of the bar that carries the head; auto: it is never in the way."),
    setting("gantry_axis", Scope::machine, &PlateSettings::gantry_axis, "Along which axis that bar spans the bed."),
    setting("conflict_tolerance", Scope::plate, &PlateSettings::conflict_tolerance, Unit::mm, 0_mm, 1_mm,
            "How deep beads of two objects, or of one and skirt, brim or tower, may lie in each other."),
};
static_assert(complete<PlateSettings>(plate_schema));

}  // namespace weft
