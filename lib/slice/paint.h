// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "mesh/mesh.h"
#include "slice/slice.h"

#include <span>
#include <vector>

namespace weft::slice {

/// How far what is painted on a surface reaches into the part.
struct PaintReach {
  Um depth = 0;  ///< from walls, across a layer; above 0
  Um roof = 0;   ///< down from what faces up
  Um floor = 0;  ///< up from what faces down
};

/// What of each layer belongs to which paint: what lies no deeper below painted outline than below any other, and what
/// lies below painted roofs and above painted floors. Of paint i result [i] has the regions of every layer; no two
/// paints overlap.
/// Distances are told apart to a thirtieth of the depth: a border between two paints, or one and no paint, is off the
/// bisector by no more.
/// @param painted facets of the surface, a mesh a paint @param outlines of the layers
/// Pre: planes ascend, one an outline.
/// Cost: thirty Booleans a painted layer.
std::vector<std::vector<Regions>> painted(std::span<const Mesh> painted, std::span<const Plane> planes,
                                          std::span<const Regions> outlines, PaintReach reach);

}  // namespace weft::slice
