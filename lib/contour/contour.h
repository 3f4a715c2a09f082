// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "contour/surface.h"
#include "model/plan.h"

#include <span>

/// Layers of gentle slopes step; here their beads follow the surface within their layer instead.
namespace weft::contour {

struct Rules {
  bool follows = false;
  Um least_height = 60;  ///< that a bead has left
  Um flat_radius = 500;  ///< of what the nozzle ends in
};

/// An object as it stands on the plate.
struct Standing {
  const Surface* surface = nullptr;  ///< null: nothing of it follows
  Point by;                          ///< what its copy is moved by
  Um lift = 0;                       ///< … upwards: by a raft, and the height of the bed
};

/// Moves walls, tops and ironing of a layer up or down to the surface of their object, by up to half the layer's
/// height, where air lies over it and it rises by no more than the nozzle's flat bears: a nozzle of radius r digs r·tan
/// β into what lies uphill, and that is to be no more than half a layer. Plastic follows: a bead is as much more or
/// less as it is higher or lower. What the next layer covers in part keeps to a quarter of it. Ways over raised beads
/// are lifted.
/// @param rules   by scope; not empty
/// @param objects by number (ObjectStart)
/// Pre:    ways and beads are known, speeds are not. Post: paths are what they were, with junctions added where the
///         surface bends.
/// Cost:   a look at the surface for each 0.4 mm of bead.
/// Source: Song et al. 2016, "Anti-aliasing for fused filament deposition", arXiv 1609.03032.
void follow(std::span<const Rules> rules, std::span<const Standing> objects, LayerPlan& layer);

}  // namespace weft::contour
