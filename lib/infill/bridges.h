// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/mask.h"
#include "infill/sparse.h"

#include <optional>

namespace weft::infill {

/// How lines over a gap run.
struct Held {
  double angle_rad = 0;
  bool ledge = false;  ///< most of them are held at one end only
};

/// The direction in which strands over `gap` hang between two supports most often, and among those the one with the
/// shortest spans. Where few strands would rest on both ends it is a ledge: the direction in which lines are held at
/// one end most often, and stand out least. Nothing where few are held at all.
/// @param below  the layer that the strands can rest on
/// Cost: 36 directions, each a scan of the gap.
std::optional<Held> held_over(const Region& gap, const Mask& below);

/// The direction in which strands over the sparse infill below `area` span the shortest free ways from line to line;
/// what is around the area holds them too. Nothing where no way is
/// long in any direction: there ordinary lines do.
/// @param nozzle diameter
/// Cost: the infill of the area, and 18 scans of it.
std::optional<double> internal_bridge_angle_rad(const Region& area, const SparseStyle& below, Um nozzle);

}  // namespace weft::infill
