// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"
#include "pipeline/layer_plastic.h"

namespace weft::pipeline {

/// How beads stand on the part: on pieces of themselves, with what the bead above them crosses in between.
struct FeetStyle {
  Um foot = 0;   ///< length of a piece
  Um apart = 0;  ///< the longest way from one to the next
};

/// Of beads that lie on the part only feet are laid there, at the ends of each run over it and evenly in between: so
/// much less is to be broken off, and to be seen. Runs that are too short for three feet are laid whole, and so are
/// those that the bead above only leans on, for longer than one crosses: so it does where a narrow column gets wider,
/// and would have nothing to lean on between feet.
/// @param on_part  where they lie on it
/// @param above    what crosses from foot to foot
Beads on_feet(Beads beads, const Regions& on_part, const LayerPlastic& above, FeetStyle style);

}  // namespace weft::pipeline
