// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "settings/settings.h"

#include <optional>

/// How far beyond their outlines things need room.
namespace weft::pipeline {

/// Around each, for what its walls lie further out than the model does.
Um wider_of(const Settings& settings);

/// Around each, for its brim.
Um brim_of(const Settings& settings);

/// Around everything and its brims, for a skirt that may not be cut off.
Um skirt_of(const Settings& settings);

/// How far skirt and brim reach beyond what they lie around.
Um beside_of(const Settings& settings);

/// Around each that is printed while others stand, for the head at any height, and for what lies around each alone; 0
/// where all grow together.
Um apart_of(const Settings& settings);

/// Between the tower and what stands beside it: the head passes there with drawn back filament.
inline constexpr Um beside_tower = 3000;

/// What the prime tower will cover, as far as is known before anything is sliced: where it is told to stand, else as
/// far back and right as it can; with the room beside it. Nothing where there will be none.
std::optional<Ring> tower_of(const Settings& settings, const Ring& surface);

}  // namespace weft::pipeline
