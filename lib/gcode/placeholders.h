// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "macro/macro.h"
#include "settings/settings.h"

#include <string>
#include <string_view>

/// What custom G-code may name (its language: macro/macro.h).
namespace weft::gcode {

/// Every setting, under weft's name and, in PrusaSlicer's units and words, under PrusaSlicer's; first-layer values that
/// are `auto` are resolved. Control characters in values become '_', so that no value can bring a line of its own.
macro::Variables variables_of(const Settings& settings);

}  // namespace weft::gcode
