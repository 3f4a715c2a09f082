// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/plan.h"
#include "settings/groups/travel.h"

#include <vector>

namespace weft::travel {

/// A closed wall with a scarf seam: it begins on a ramp, goes round, and ends above the ramp with ever less flow.
struct Scarf {
  std::vector<Junction> ramp;  ///< flow is the share of the band that lies below the nozzle
  std::vector<Um> below;       ///< beside ramp: how far below the layer's top it is printed
  std::vector<Junction>
      body;  ///< from the end of the ramp to where it began; a single junction when there is nothing between
  std::vector<Junction> cover;  ///< the way of the ramp once more, at the layer's top: what the ramp left open
};

/// Cuts a wall so; one shorter than twice the seam has a seam of half its length.
/// @param path   closed: its first junction is repeated at its end
/// Pre:  scarf_joint_seam_length > 0.
/// Post: together the pieces hold the volume of the path.
Scarf scarfed(const TravelSettings& settings, const std::vector<Junction>& path, Um height);

}  // namespace weft::travel
