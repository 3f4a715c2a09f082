// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/sparse.h"

namespace weft::infill {

/// Evenly spaced lines along the object's field of directions (Prepared::direction), b/ρ apart, or along the style's
/// angle where it has none. Where lines come nearer to each other or part they are narrower or wider, as their gaps.
/// Every second layer runs across, unless angles are given for layers: those are added to the field's.
/// Source: Jobard & Lefer 1997, "Creating evenly-spaced streamlines of arbitrary density"; Runge & Kutta's fourth
/// order. Cost: about 4 µs a mm of line.
void fill_streamlines(const Region& region, const SparseStyle& style, Beads& beads);

}  // namespace weft::infill
