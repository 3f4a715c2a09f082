// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/settings.h"

/// How far beyond their outlines things need room.
namespace weft::pipeline {

/// Around each, for its brim.
Um brim_of(const Settings& settings);

/// Around everything and its brims, for a skirt that may not be cut off.
Um skirt_of(const Settings& settings);

/// Around each that is printed while others stand, for the head at any height; 0 where all grow together.
Um head_of(const Settings& settings);

}  // namespace weft::pipeline
