// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "model/plan.h"

#include <span>

/// Walls and skin that hang over air: found along the beads that are about to be printed, cut out of them and marked,
/// so that motion gives them a speed and a fan of their own.
namespace weft::overhangs {

/// What a strand over air is.
struct Strand {
  Um nozzle = 400;     ///< diameter
  double share = 1;    ///< plastic in it, as a share of a round strand of that diameter
  bool marked = true;  ///< what lies over air is told apart at all
};

/// Of what lies over air, the parts that are large enough to matter: rough walls leave thousands of slivers.
Regions worth_keeping(Regions over_air);

/// Cuts the walls and the skin of a layer where the share of their width that lies over air passes a quarter, a half,
/// or three quarters, and marks the pieces (Extrude::air_quarters). What lies over air with all of its width is an
/// overhang wall, or skin (RoleRow::hangs_as); a wall that is straight there and held at both ends is laid as a free
/// strand: round, of the nozzle's diameter. What is held at one end, or not at all, keeps its width: what stuck to its
/// neighbour as a wall would be pulled from it as a strand. Pieces shorter than a millimetre are joined with each other
/// where they follow each other, and lie as they do on the mean; single ones go to the piece beside that is most like
/// them: a nozzle does not change its speed, nor a fan its own, for less. What lies on nothing is told from half a
/// millimetre on: a corner that sticks out so far curls.
/// @param strands by scope (Extrude::scope); a scope that is not there has the first's. Pre: not empty
/// @param over_air where nothing of the layer below lies, on the plate. Pre: orientation as Region says.
/// Post: no bead is touched whose scope does not ask for it (Strand::marked), none that has less than a tenth of its
///       width over air all along, nor any that is neither wall nor skin or that climbs (Extrude::below). Pieces of a
///       bead follow each other; their paths together are its path.
/// Cost: nothing in layers where nothing hangs; else O(n) to index what hangs, and about 0.5 µs for each 0.4 mm of bead
///       that is near it.
void mark(std::span<const Strand> strands, Regions over_air, LayerPlan& layer);

/// The longest way over air of what is laid straight there: bridges, and strands of walls; mm.
/// @param over_air of the layer
double longest_span_mm(const Regions& over_air, const LayerPlan& layer);

}  // namespace weft::overhangs
