// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "walls/laying.h"

/// Private to walls: inner walls around corners that point into the part.
namespace weft::walls {

/// Where a thin part bends, walls at even distances from the outline go round on the inside of the bend and at once on
/// its outside: a bead between them would have to become twice as wide for less than a millimetre, which no extruder
/// does. So inner walls on the inside go straight on and bend at once, too, and all beads keep their widths. The outer
/// wall does not: its edge is seen. Sets Laying::mitres.
void mitre_inner_walls(const Skeleton& skeleton, Laying& laying);

/// Where an inner wall at that distance from the sides of a corner bends at once, if it does so over this half, µm.
inline std::optional<Place> bend_of(const Skeleton& skeleton, const Laying& laying, std::uint32_t half,
                                    double distance) {
  const auto& bend = laying.mitres[half].bend;
  if (!bend) return {};
  const Place foot = skeleton.halves[half].foot;
  return Place{foot.x + distance * bend->way.x, foot.y + distance * bend->way.y};
}

}  // namespace weft::walls
