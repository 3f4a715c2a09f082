// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "infill/density.h"
#include "infill/sparse.h"
#include "model/bead.h"

namespace weft::infill {

/// Loops at even distances from the edge; their width makes up for the middle, where they do not come out even.
void fill_concentric(const Region& region, const SparseStyle& style, Beads& beads);

/// Loops as far apart at each place as its density asks for: lines u = k + ½ of |∇u| = ρ ÷ band, u = 0 at the edge. All
/// are as wide as usual.
void fill_concentric(const Region& region, const SparseStyle& style, const Density& density, Beads& beads);

}  // namespace weft::infill
