// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/tolerances.h"

#include <cmath>
#include <cstddef>
#include <vector>

/// A bead's path and its width, told with as few moves as both allow.
namespace weft {

/// A vertex of a centreline in fractional microns.
struct PathVertex {
  double x = 0, y = 0;
  double band = 0;  ///< µm
  friend bool operator==(const PathVertex&, const PathVertex&) = default;
};
using VertexPath = std::vector<PathVertex>;

inline PathVertex lerp(const PathVertex& a, const PathVertex& b, double t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.band + t * (b.band - a.band)};
}
inline double length_of(const PathVertex& a, const PathVertex& b) {
  const double x = b.x - a.x, y = b.y - a.y;
  return std::sqrt(x * x + y * y);
}
/// A bead whose edges lie tolerances::path off along half of tolerances::shortest_piece, the shortest ramp, µm³.
inline constexpr double worth_of_a_bead_move = 0.5 * tolerances::path * tolerances::path * tolerances::shortest_piece;

/// Whether the width is the same all along the path.
bool is_even(const VertexPath& path);

/// Tells a path by the pieces that are worth their moves (pieces.h), none shorter than tolerances::least_move unless
/// the whole is. Ends stay. Pieces lie in the middle of what they stand for and lay what was laid there, as nearly as
/// places and widths that are linear between vertices can; an even band stays even. Post: at least two vertices, three
/// of a closed path. Returns, for each vertex, which one of the path as it was it is, or lies behind; a closed path may
/// begin at another one than before. Cost: O(n log n) where the path turns evenly. Source: L² projection on hat
/// functions.
/// @param worth_of_a_move what a piece may be off, squared and along it, to save one, µm³ (pieces.h)
std::vector<std::size_t> simplify(VertexPath& path, bool closed, double worth_of_a_move = worth_of_a_bead_move);

/// Firmware extrudes evenly along a move: into how many pieces one of that length (µm) is cut along which the band
/// changes by so much (µm), so that in none it changes by more than tolerances::band_step. Pieces are at least
/// tolerances::shortest_piece long, or half of that where they would change by more than tolerances::band_leap.
int ramp_pieces(double change_um, double length_um);

/// Cuts the pieces of a path so. The volume stays.
void cut_ramps(VertexPath& path, bool closed);

}  // namespace weft
