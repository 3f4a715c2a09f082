// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/level_set.h"

#include <vector>

namespace weft::infill {

/// What u is where no front has come to.
inline constexpr double unreached = 1e18;

/// |∇u| = slowness on a grid: when a front that starts at known places is everywhere.
/// @param slowness of the front, by node, 1/µm
/// @param u        known values; `unreached` where it is to be found, negative where the front does not go
/// Post: what no front reaches stays `unreached`.
/// Source: Zhao 2005, "A fast sweeping method for Eikonal equations". Cost: O(nodes) a
/// sweep, of which there are four where the front turns nowhere.
void sweep_front(const LevelGrid& grid, const std::vector<double>& slowness, std::vector<double>& u);

}  // namespace weft::infill
