// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "model/bead.h"
#include "pipeline/beneath.h"

#include <span>

namespace weft::pipeline {

struct RungStyle {
  Um span = 0;            ///< the longest way that a bead may cross freely
  Um line = 0, band = 0;  ///< widths of a bead
};

/// Rungs for beads of the layer above that would hang: each from one bead of this layer to another, on a rung of the
/// layer below or where its ends lie on something if there is such a place, as near to each other as beads may cross
/// freely.
/// @param hang   places where beads above hang
/// @param beads  what is laid already: rungs end on it
/// @param area   of support: no rung leaves it
/// @param below  what this layer lies on
/// @param under  the rungs of that
/// Post: a rung's sequence is not 0: it is printed when what it ends on is there.
Beads rungs_below(std::span<const Point> hang, const Beads& beads, const Regions& area, const Beneath& below,
                  const Beads& under, const RungStyle& style);

}  // namespace weft::pipeline
