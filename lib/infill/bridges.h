// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/mask.h"

#include <optional>

namespace weft::infill {

/// The direction in which strands over `gap` hang between two supports most often, and among those the one with the
/// shortest spans. Nothing when few strands would rest on both ends: then it is a ledge, not a bridge.
/// @param below  the layer that the strands can rest on
/// Cost: 36 directions, each a scan of the gap.
std::optional<double> bridge_angle_rad(const Region& gap, const Mask& below);

}  // namespace weft::infill
