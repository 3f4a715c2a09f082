// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "prusaslicer/lines.h"

#include <string>
#include <vector>

/// What weft has to know of the custom G-code of a PrusaSlicer configuration beside its text.
namespace weft::prusaslicer {

/// Where the custom G-code itself goes beyond the bed.
struct CustomReach {
  std::string setting;  ///< machine_reach, machine_reach_z_min or machine_reach_z_max
  std::string value;    ///< as a profile writes it
  std::string why;      ///< the move that goes farthest: "start_gcode goes there: G1 Y-3.0 F1000.0"
  std::string beyond;   ///< by how much it is widened: "3 mm in front of the bed, 4 mm on its right"
};

/// PrusaSlicer knows a bed and no reach, while stock start G-code wipes the nozzle in front of the bed on purpose. A
/// move with plain coordinates up to 60 mm off the bed, 20 mm above the highest print or 5 mm below the bed's surface
/// is taken for something that this printer can do; what goes farther, or is reckoned while slicing, is left to the
/// audit. Empty when no such move leaves the bed and the height.
std::vector<CustomReach> reach_of(const Lines& lines);

/// The lines of `gcode_variables`: the keys that custom G-code names and that no setting of weft's stands for.
std::string variables_of(const Lines& lines);

}  // namespace weft::prusaslicer
