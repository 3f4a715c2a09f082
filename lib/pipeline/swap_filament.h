// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"
#include "model/plan.h"
#include "settings/settings.h"

#include <array>
#include <optional>
#include <vector>

/// How one filament leaves a nozzle that another then comes into, where the firmware does not do that by itself.
namespace weft::pipeline {

/// The piece of a line that the nozzle goes to and fro on; nothing: it stays where it is.
using Along = std::optional<std::array<Point, 2>>;

/// So fast for so long.
struct Rammed {
  double mm3_s = 0, seconds = 0;
};
/// What filament_ramming_parameters ask for.
std::vector<Rammed> ramming_of(const ToolSettings& tool);
double volume_of(const std::vector<Rammed>& rammed);

/// Along a line of the tower, as far as each flow comes in its time; at its end back again. The nozzle is there.
/// @param shared the tip is shaped; else filament_multitool_ramming_volume is laid
/// Pre: settings are checked (profile/profile.h); the line has two points
std::vector<Step> lay_rammed(const Settings& tool, const Bead& line, Um height, bool shared);

/// The tip is drawn out as far as the tube that it cools in, moved to and fro there (and stamped, where
/// filament_stamping_distance says so), and parked. Meanwhile the nozzle
/// goes on along what is purged next, so that it melts no hole and leaves no blob where it stands.
/// Empty where parking_pos_retraction is 0.
/// Source: PrusaSlicer's description of its wipe tower: 15 mm at the first speed, then 70, 20 and 10 % of the rest at
/// 1, 0.5 and 0.3 × the second.
std::vector<Step> unload(const Settings& tool, const Along& along, Um z);

/// The other is pushed in: 20 % at its first speed, 70 % at its second, the rest at a tenth of that.
std::vector<Step> load(const Settings& tool, const Along& along, Um z);

}  // namespace weft::pipeline
