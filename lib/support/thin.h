// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

namespace weft::support {

/// What of support is beside more of it may lie so far from that, or over it: far less than beads do, and outlines that
/// do not lie on each other are cut in a third of the time.
inline constexpr Um beside_by = 3;

/// What of others may lie beside a region, or over it, by that rule or by a hair that is wider: as much of them as
/// geometry::beyond asks for. The rest of them is mostly left off.
Regions near_to(const Region& region, const Regions& others, Um hair = beside_by);

/// Strips thinner than two lines of what is `fresh`, made as wide as that.
void thicken(Regions& area, const Regions& fresh, Um line);

/// What of columns is thinner than twice that goes: no bead has room in it.
inline Um thin_column(Um line) {
  return line * 4 / 10;
}

/// What is thinner than twice the radius goes, and tips sharper than 39°. Other corners stay as they are: what is
/// rounded on one level would leave nothing below the corners of the next. Post: nothing reaches out of the area
/// further than offsets are rounded.
Regions without_thin(const Regions& area, Um radius);

}  // namespace weft::support
