// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/field.h"

#include <vector>

namespace weft::support {

/// How far a place of a contact may be from the next branch.
struct TipSpacing {
  Um inside = 0, rim = 0;  ///< rim <= inside
};

/// The end of a branch.
struct TipShape {
  Um radius = 0, line = 0;  ///< and the width of its bead
};

/// Where branches begin under a contact so that no place of it is further from one than that.
/// @param around    contacts of levels nearby, and this one: a rim inside of them hangs no further out than they do.
///                  Empty: all of the rim is free
/// @param standing  where branches already are on that level: those below the contact hold what lies near them
/// Post: none nearer to another than half of it, but where the contact is narrow.
std::vector<Point> tips_under(const Regions& contact, const Regions& around, const std::vector<Point>& standing,
                              TipSpacing spacing, const Field& field, std::size_t slab, TipShape shape);

}  // namespace weft::support
