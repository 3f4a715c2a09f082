// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"

#include <vector>

/// Firmware takes a limited number of moves a second and extrudes evenly along each. So beads get as few moves as their
/// shape allows, and as many as their change of width needs.
namespace weft::motion {

/// How many times as large as for walls tolerances are.
struct Coarseness {
  double path = 1, band = 1;
  double worth = 1;  ///< of a move, over what `path` makes of it
};
/// For beads of a role: lines of infill are told coarsely, rounds of support finely.
Coarseness coarseness(Role role);

/// Drops junctions that tell nothing (model/simplify). Ends stay in place; flow gives way where it varies, else width.
/// @param times as large tolerances are: what is simplified is the path made so many times as small
void thin_out(std::vector<Junction>& path, Coarseness times = {});

/// Cuts segments along which band times flow changes by more than tolerances::band_step, into pieces of at least
/// tolerances::shortest_piece, or half of that where they would change by more than tolerances::band_leap. The volume
/// stays.
/// @param times as large those tolerances are
void cut_where_width_changes(std::vector<Junction>& path, Coarseness times = {});

/// Both.
inline void resample(std::vector<Junction>& path, Coarseness times = {}) {
  thin_out(path, times);
  cut_where_width_changes(path, times);
}

}  // namespace weft::motion
