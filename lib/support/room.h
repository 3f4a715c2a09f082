// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "support/stack.h"

#include <vector>

namespace weft::support {

/// Where no support may be on a level.
struct KeepOut {
  Regions near;   ///< the part beside, grown by support_xy_distance
  Regions touch;  ///< grown by the distance that holds beside contacts only
  Regions over;   ///< the part less than a gap above or below
};

/// Of every level. Cost: two offsets and a union each, side by side.
std::vector<KeepOut> keep_outs(const SupportSettings& settings, const Object& object, const Stack& stack);

/// The layers of the object [from, to) that share height with (low, high).
struct LayerRun {
  std::size_t from = 0, to = 0;
};
LayerRun layers_between(const Object& object, Um low, Um high);

/// Their outlines together.
Regions outlines_between(const Object& object, Um low, Um high);

/// What blockers mark there.
Regions blocked_between(const Object& object, Um low, Um high);

/// Of each level, what of the plane has something of the object anywhere below: what cannot stand on the plate.
std::vector<Regions> shadows(const SupportSettings& settings, const Object& object, const Stack& stack);

/// Distance to the part beside, µm.
Um beside(const SupportSettings& settings, const Object& object);

}  // namespace weft::support
