// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "walls/laying.h"

#include <algorithm>

/// Private to walls: inner walls around corners that point into the part.
namespace weft::walls {

/// Where a thin part bends, walls at even distances from the outline go round on the inside of the bend and at once on
/// its outside: a bead between them would have to become twice as wide for less than a millimetre, which no extruder
/// does. So inner walls on the inside go straight on and bend at once, too, and all beads keep their widths. The outer
/// wall does not: its edge is seen. Sets Laying::mitres.
void mitre_inner_walls(const Skeleton& skeleton, Laying& laying);

/// Whether the ribs of a half stand in one place, as nearly as the axis is known.
inline bool stands_in_a_corner(const Skeleton& skeleton, std::uint32_t half) {
  constexpr double one_place_um = 0.1, share = 0.02;  // so near, or at so much of the axis' way
  const auto& halves = skeleton.halves;
  return distance(halves[half].foot, halves[halves[half].next].foot) <=
         std::max(one_place_um, share * skeleton.length(half / 2));
}

/// Where an inner wall at that distance from the sides of a corner bends at once, if it does so over this half, µm.
inline std::optional<Place> bend_of(const Skeleton& skeleton, const Laying& laying, std::uint32_t half,
                                    double distance) {
  const auto& bend = laying.mitres[half].bend;
  if (!bend) return {};
  const Place foot = skeleton.halves[half].foot;
  return Place{foot.x + distance * bend->way.x, foot.y + distance * bend->way.y};
}

}  // namespace weft::walls
