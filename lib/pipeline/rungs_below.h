// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "model/bead.h"

#include <span>

namespace weft::pipeline {

struct RungStyle {
  double direction_rad = 0;  ///< across the lines of columns
  Um span = 0;               ///< the longest way that a bead may cross freely
  Um line = 0, band = 0;     ///< widths of a bead
};

/// Rungs for beads of the layer above that would hang between two lines of a column: from one line to the next, as near
/// to each other as beads may cross freely.
/// @param hang   places where beads above hang
/// @param beads  what is laid already: rungs end on it
/// @param area   of columns: no rung leaves it
Beads rungs_below(std::span<const Point> hang, const Beads& beads, const Regions& area, const RungStyle& style);

}  // namespace weft::pipeline
