// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <optional>

/// Areas that are narrow and long.
namespace weft::infill {

/// In lines: wider areas are filled across, or at an angle to their edge. A line at 45° across one of five lines is 3
/// mm long with a nozzle of 0.4: at 60 mm/s and 3 m/s² the nozzle is at speed for half of it, and an extruder that
/// lags by 40 ms is not there before its end. A line along the edge has neither.
inline constexpr double widest_strip = 5.5;

/// The direction (against X) of the longer axis of an area that is longer than wide, also where its edge follows the
/// cells of a grid by steps.
/// @param bend the most, µm, that it may stand out across that beyond its mean width; nothing: it may bend
std::optional<double> angle_of_axis(const Region& region, std::optional<double> bend = {});

/// The direction (against X, from −1° to 90°) of most of the area's straight edge, when half of that runs that way or
/// across, and a quarter of all edge. Lines along straight walls end square on the walls across, so they leave nothing
/// open; round walls are alike to any lines. Walls run one way to microns; an edge that other areas were cut off at is
/// not as exact, and where it is longer than any wall it does not count for more than they do together.
std::optional<double> angle_along_walls(const Region& region);

/// The direction (against X) of a straight strip no wider than some lines: across it they would be dabs with a turn
/// between each two, on every second layer.
std::optional<double> angle_along_strip(const Region& region, Um band);

/// The direction (against X) of the longer axis of an area no wider than some lines that is longer than wide, and
/// nearly straight, whichever way its edge runs: lines along it are the fewest, and the longest.
std::optional<double> angle_along_narrow(const Region& region, Um band);

/// Of lines that run that way and of those across the ones that have no more than half as many ends, where either has.
std::optional<double> angle_of_long_lines(const Region& region, double angle_rad);

/// Whether an area is a strip everywhere no wider than some lines, and long.
bool is_strip(const Region& region, Um band);

}  // namespace weft::infill
