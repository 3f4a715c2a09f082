// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/sparse.h"

namespace weft::infill {

/// Lines between walls and medial axis, as many everywhere, so that where walls come nearer lines do too and are
/// narrower: isolines of u = d_wall / (d_wall + d_axis) at (k + ½) / n, joined to one line a region.
/// Branches of the axis into corners of 90° and more are left out, lines run around those corners instead.
/// Source: Ding et al. 2016, "Adaptive path planning for wire-feed additive manufacturing using medial axis
///         transformation"; joined as Zhao et al. 2016 (fermat.h). Cost: O(cells of b/5ρ · log edges).
void fill_medial(const Region& region, const SparseStyle& style, Beads& beads);

}  // namespace weft::infill
