// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/simplify.h"

/// Private to model: which straight pieces stand for a path, so that a bead is printed with few moves.
namespace weft {

/// A place on a path: the share `t` of the way from vertex `from` to the next, below 1.
struct Stop {
  std::size_t from;
  double t;
};

/// Where the pieces of an open path end that are worth their moves, from its first vertex to its last: the sum is least
/// of one for each move (a piece along which the band changes is cut into more, `cut_ramps`) and of what it is off,
/// `∫ d² + (w/2)² ds` over all of it, for the straight bead that is nearest to its stretch; d is how far its line lies
/// off, w how far its band, so that both edges of the bead count alike. What is off by as much as a move is worth
/// counts like one. None cuts off where the path turns back, unless all others are too short: no piece is shorter than
/// `least_piece`, unless the whole is. Pieces end where the two beads that meet there are off alike, to which the
/// path's own vertices need not come near: a round corner is cut evenly, whatever its vertices. The same from either
/// end. Pre: at least two vertices. Cost: O(n) where a piece stands for a few vertices. Source: Perez & Vidal 1994,
/// "Optimum polygonal approximation of digitized curves" (dynamic programming); Lloyd 1982 (ends); here with lines that
/// need not pass through vertices.
/// @param worth_of_a_move µm³, > 0
std::vector<Stop> ends_of_pieces(const VertexPath& path, double worth_of_a_move = worth_of_a_bead_move);

/// No piece is shorter: an end of it may be moved by tolerances::path yet.
inline constexpr double least_piece = tolerances::least_move + tolerances::path;

}  // namespace weft
