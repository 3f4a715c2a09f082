// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <string_view>
#include <vector>

namespace weft {

/// What of the print head is above the nozzle's tip, from one height up to the next slab's, or for ever.
struct HeadSlab {
  Um from = 0;   ///< above the tip, >= 0
  Ring outline;  ///< around the nozzle, seen from above; counter-clockwise, at least three corners
};

/// `0: -10x-10, 10x-10, 10x10, -10x10; 12: …`: heights in mm, ascending, and polygons around the nozzle. Empty: nothing
/// is known of the head. @throws std::invalid_argument with one clause for what is none
std::vector<HeadSlab> parse_head_profile(std::string_view text);

struct PlateSettings;
struct MachineSettings;

/// What the head is made of: the slabs of machine_head_profile, and the bar, as wide as the bed. Empty: nothing is
/// known of it.
std::vector<HeadSlab> head_of(const PlateSettings& plate, const MachineSettings& machine);

}  // namespace weft
