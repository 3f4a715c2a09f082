// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

namespace weft::pipeline {

/// Whether a region's outline comes further than `by` µm from the outlines of what lies within. It is looked at in its
/// corners and, on long edges, in steps of no more than `by`: what comes out between two by less than half of it may be
/// missed. Pre: by > 0. Cost: O(steps) where outlines run beside each other, else that of an index of those within.
bool reaches_further(const Region& region, const Regions& within, Um by);

}  // namespace weft::pipeline
