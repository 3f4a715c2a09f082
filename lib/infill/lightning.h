// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <optional>
#include <span>
#include <vector>

namespace weft::infill {

/// A layer as branches see it.
struct LightningLayer {
  Um height = 0;
  Regions sparse;  ///< to be filled
};

/// In the layer's height.
struct LightningLean {
  double tips = 1, bends = 1;           ///< how far branches move from layer to layer
  std::optional<double> beside_wall{};  ///< what carries itself there; absent: as much as beside a branch
};

/// Branches below what is solid above sparse infill, and nothing elsewhere: from the top downwards each place that
/// hangs farther than `radius` from branches, and than what `lean` says from walls, grows one, to whichever is nearer;
/// further down tips are shortened, paths straightened and roots kept at the wall, none moved by more than the layer's
/// height allows.
/// @param origin  what moves with the object: places that are looked at stand on a lattice around it
/// @returns the branches of each layer. They end at walls a little outside of the area, so that they are cut there.
/// Source: Tricard, Claux, Lefebvre 2020, "Ribbed support vaults for 3D printing of hollowed objects".
/// Cost: O(layers · branches · edges nearby), the layers one after the other.
std::vector<std::vector<Polyline>> lightning(std::span<const LightningLayer> layers, double radius, LightningLean lean,
                                             Point origin);

}  // namespace weft::infill
