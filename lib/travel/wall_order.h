// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "travel/blocks.h"

namespace weft::travel {

/// The end points of a bead on its turn.
Point begin_of(const Bead& bead, const Turn& turn);
Point end_of(const Bead& bead, const Turn& turn);

/// The walls of one block in order, with where each begins.
///
/// Walls that touch keep the order of the list; otherwise the nearest one whose predecessors are done comes next, and
/// whole runs of walls are then moved where that shortens the way. Outer walls begin at their seam; inner ones beside
/// the seam of an outer wall they lie along, so that the way from one wall to the next is a line's width.
/// @param from where the nozzle is
/// @param to   where it goes on to, if that is known
std::vector<Turn> order_walls(const TravelSettings& settings, const Prepared& layer, const Linked& linked,
                              std::uint32_t block, std::optional<Point> from, std::optional<Point> to);

/// The bead's turn, begun as near to `at` as it can be.
Turn nearest_turn(const Beads& beads, std::uint32_t block, std::uint32_t bead, std::optional<Point> at);

}  // namespace weft::travel
