// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/level_set.h"

#include <optional>
#include <vector>

namespace weft::infill {

/// Curves of the plane that repeat every period along both axes, of which one period is known.
struct RepeatedCurve {
  std::vector<Turned> points;
  int across = 0, up = 0;  ///< periods from its first point to where it begins anew; both 0: it is closed
};

/// @param curves  zero curves of one period: of the nodes 0 … n along each axis, of which the last are the first
/// @returns nothing where an end has no continuation at the opposite border: a curve runs through a node
std::optional<std::vector<RepeatedCurve>> join_over_borders(const LevelGrid& period, std::vector<Curve> curves);

/// All of them that meet the area, a little beyond it.
std::vector<Curve> repeat(const std::vector<RepeatedCurve>& curves, double period_um, const Span2& area);

}  // namespace weft::infill
