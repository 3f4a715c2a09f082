// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <optional>

/// Areas that are narrow and long.
namespace weft::infill {

/// The direction (against X) of the longer axis of an area that is longer than wide, also where its edge follows the
/// cells of a grid by steps.
/// @param bend the most, µm, that it may stand out across that beyond its mean width; nothing: it may bend
std::optional<double> angle_of_axis(const Region& region, std::optional<double> bend = {});

/// The direction (against X) of a straight strip no wider than some lines: across it they would be dabs with a turn
/// between each two, on every second layer.
std::optional<double> angle_along_strip(const Region& region, Um band);

/// Whether an area is a strip everywhere no wider than some lines, and long.
bool is_strip(const Region& region, Um band);

}  // namespace weft::infill
