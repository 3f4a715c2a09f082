// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "settings/groups/adhesion.h"

#include <optional>

namespace weft::adhesion {

/// Where of its parts a brim is wanted: around tips (brim_ears), where the foot is narrow (brim_narrow_width), or both;
/// with everything around them that a brim may cover. Nothing: all along.
/// @param outlines of the first layer
std::optional<Regions> brim_places(const AdhesionSettings& settings, const Regions& outlines);

}  // namespace weft::adhesion
