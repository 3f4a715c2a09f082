// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/solid.h"

namespace weft::infill {

/// As fill_solid; but straight slots of the region, no wider than about two lines, get lines of their own along them.
/// Lines at an angle would be dabs there, swing in width where they cross it aslant, or stand astride of it; and arms
/// that are alike would be filled in as many ways as they have directions. Cost: that of fill_solid, and where two
/// edges face each other as a slot's do an opening of the region.
void fill_solid_and_slots(const Region& region, const SolidStyle& style, Beads& beads);

}  // namespace weft::infill
