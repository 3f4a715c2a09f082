// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "model/layer.h"

namespace weft::test {

/// What the walls of a layer leave bare and lay twice, mm².
struct Coverage {
  double walled = 0;   ///< what walls are to fill: the part less its inside
  double bare = 0;     ///< of it, under no bead
  double twice = 0;    ///< under two, or twice under one that comes back
  double outside = 0;  ///< under a bead, but outside of the part
};

/// Counted on a raster, in a way that has nothing in common with how walls are repaired: a bead is the discs of its
/// width that its nozzle passes through, and a cell counts where a disc covers its middle.
Coverage coverage_of(const Regions& regions, const WallLayer& walls, Um cell);

}  // namespace weft::test
