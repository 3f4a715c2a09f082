// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/solid.h"

namespace weft::infill {

/// As fill_solid; and where its lines leave out more than corners, slots no wider than a line get one of their own,
/// which two lines stood astride of. Cost: that of fill_solid, and where it leaves something out an opening of the
/// region.
void fill_solid_and_slots(const Region& region, const SolidStyle& style, Beads& beads);

}  // namespace weft::infill
