// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "model/bead.h"
#include "settings/groups/walls.h"

#include <cstddef>

/// Private to walls: where the outermost bands end.
namespace weft::walls {

/// The regions with their outlines moved by the xy offsets.
Regions offset_outlines(const WallSettings& settings, const Regions& regions);

/// The regions of a first layer, their outlines drawn in by `by` more than `xy_offset` says of the others: what would
/// be thinner than `least` thereby, two walls that stand on their own, stays as it is. An elephant's foot is of what is
/// heavy above; a rib has none, and would stick to the bed with half of itself.
Regions drawn_in(const WallSettings& settings, const Regions& regions, Um by, Um least);

/// A part less what the rounded sides of its outermost beads stand out beyond their bands.
struct Within {
  Regions regions;
  Regions thin;  ///< stretches of the part thinner than two such sides
};

/// Cost: O(n log n), about 0.5 µs a vertex, 2 µs where something is that thin.
Within within(const Region& part, Um bulge);

/// Strands narrower than high have no rounded sides (model/flow.h): single beads get back what `bulge` took from them.
void widen_thin(Um bulge, Um height, Beads& beads);

}  // namespace weft::walls
