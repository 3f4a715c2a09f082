// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "plate/plate.h"
#include "settings/settings.h"
#include "slice/paint.h"
#include "slice/slice.h"

#include <span>
#include <vector>

/// What is painted on an object, as areas of its layers.
namespace weft::pipeline {

/// Is anything painted on it?
bool is_painted(const Object& object);

/// How deep paint goes: paint_depth from walls, and through the shells from tops and bottoms.
slice::PaintReach paint_reach(const Settings& settings);

/// The areas of each tint among the object's volumes, as if it had been cut.
/// @param cuts beside the object's volumes, all at the same heights; those of tints are not looked at
/// @return beside the volumes too; empty for others than tints
std::vector<std::vector<slice::Cut>> paint_cuts(const Object& object, slice::PaintReach reach,
                                                std::span<const std::vector<slice::Cut>* const> cuts);

}  // namespace weft::pipeline
