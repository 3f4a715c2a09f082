// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"
#include "model/plan.h"
#include "settings/settings.h"

#include <optional>
#include <vector>

/// How one filament leaves a nozzle that another then comes into, where the firmware does not do that by itself.
namespace weft::pipeline {

/// The tip is shaped on the way along `ram`, drawn out as far as the tube that it cools in, moved to and fro there,
/// and parked. Empty where parking_pos_retraction is 0.
/// Source: PrusaSlicer's description of its wipe tower: 15 mm at the first speed, then 70, 20 and 10 % of the rest at
/// 1, 0.5 and 0.3 × the second.
/// @param ram a line of the tower; nothing: it is not shaped
/// @param z, height of the layer
/// Pre: settings are checked (profile/profile.h)
std::vector<Step> unload(const Settings& tool, const std::optional<Bead>& ram, Um z, Um height);

/// The other is pushed in: 20 % at its first speed, 70 % at its second, the rest at a tenth of that.
std::vector<Step> load(const Settings& tool);

}  // namespace weft::pipeline
