// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"

namespace weft::pipeline {

/// How beads stand on the part: on pieces of themselves, with what the bead above them crosses in between.
struct FeetStyle {
  Um foot = 0;   ///< length of a piece
  Um apart = 0;  ///< the longest way from one to the next
};

/// Of beads that lie on the part only feet are laid there, at the ends of each run over it and evenly in between: so
/// much less is to be broken off, and to be seen. Runs that are too short for three feet are laid whole.
/// @param on_part  where they lie on it
Beads on_feet(Beads beads, const Regions& on_part, FeetStyle style);

}  // namespace weft::pipeline
