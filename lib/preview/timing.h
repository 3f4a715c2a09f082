// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "preview/toolpaths.h"
#include "settings/groups/machine.h"

namespace weft::preview {

/// Sets Stroke::seconds: what the machine's planner makes of the moves in the file, with the accelerations that the
/// file asks for, else the machine's. From rest to rest in each layer. Files of any slicer are timed by the same rule.
/// Source: motion/kinematics.h. Cost: linear, layers side by side.
void set_seconds(Toolpaths& paths, const MachineSettings& machine);

/// Seconds of a layer, with its retractions. Pre: set_seconds.
double seconds_of(const PathLayer& layer);

}  // namespace weft::preview
