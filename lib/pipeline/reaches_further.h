// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

namespace weft::pipeline {

/// Whether a region's outline comes further than that from what lies within, to half of it between places that far from
/// each other. Cost: O(corners) where outlines run beside each other, else that of an index of the outlines within.
bool reaches_further(const Region& region, const Regions& within, Um by);

}  // namespace weft::pipeline
