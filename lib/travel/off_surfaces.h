// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "travel/travel.h"

/// Private to travel: where ways stay off what will be seen, outer walls and top skin. Each area holds the one before;
/// a way takes the first that has one, because oozing along an outer wall's edge is still better than another end of
/// it.
namespace weft::travel {

/// Within the walls next to the outer ones, or a bead inside of those where there are none. @param outline of the parts
Comb within_second_walls(const LayerInput& input, const Regions& outline);

/// Half a bead inside of the outer walls' centrelines: a neck of three beads is gone through along its middle. What
/// oozes there lies on the bead, and not over its edge.
Comb half_a_bead_within(const LayerInput& input);

/// Within the outer walls' centrelines: a neck of two beads.
Comb within_outer_walls(const LayerInput& input);

/// The centrelines of outer walls, open ones there and back: what lies near its boundary lies on such a bead.
Comb outer_walls(const LayerInput& input);

/// The centreline of a closed bead.
Ring ring_of(const Bead& bead);
/// Whether it is a closed outer wall, whose begin is seen.
bool begins_a_seam_line(const Bead& bead);
/// The centrelines of all closed outer walls.
std::vector<Ring> outer_wall_rings(const LayerInput& input);
/// What is told of the layer's objects, all together.
Regions gathered(const LayerInput& input, Regions ObjectLayer::*which);

}  // namespace weft::travel
