// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <cstddef>
#include <vector>

namespace weft {

/// Of each region, the number of the first of them from which it differs by no more than its place; its own where none
/// is like it. Rings have to begin at the same corner, and holes to come in the same order, as those of bodies that are
/// copies of each other do. Exact. Pre: no outer ring is empty. Cost: linear in corners, and O(n log n) in regions.
std::vector<std::size_t> first_alike(const Regions& regions);

}  // namespace weft
