// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/settings.h"

#include <cstddef>
#include <string_view>

namespace weft::preview {

/// What the moves of a file take.
struct FileTime {
  double seconds = 0;     ///< without heating, macros and waiting for people
  std::size_t moves = 0;  ///< as the firmware plans them: arcs in pieces
};

/// The time of any slicer's G-code as the machine's firmware plans it: all moves that begin at a known place, in one
/// stretch but where the nozzle rests. Pauses of known length (G4) count.
/// Cost: linear in bytes; memory for the moves between two rests.
/// Source: motion/kinematics.h.
FileTime time_of(std::string_view gcode, const Settings& settings);

}  // namespace weft::preview
