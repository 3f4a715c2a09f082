// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/groups/walls.h"

#include <vector>

/// Private to walls: how many beads share a thickness, and how wide each is.
namespace weft::walls {

/// The settings of the beading, resolved to what beads take of the thickness, in fractional microns: their bands where
/// overlap_factor is 1, else more.
struct Widths {
  double outer = 0, inner = 0;           ///< nominal
  double least_even = 0, least_odd = 0;  ///< a middle bead splits in two of, appears with, at least this
  double most = 0;                       ///< no bead is wider
  double open = 0;                       ///< narrowest gap that is left to infill
  double least_feature = 0;              ///< thinner parts of what walls get are left out
  Um bulge = 0;                          ///< so far inside the outline lies what walls get
  int walls = 0;                         ///< on each side
  int shared = 1;                        ///< innermost beads of a side that take up the difference
  double least_area = 0;                 ///< of beads that are too thin to count for themselves, µm²
};

/// `layer` has one more wall on odd layers with alternate_extra_wall.
Widths widths_of(const WallSettings& settings, Um nozzle_diameter, Um height, std::size_t layer);

/// The beads across a part, from one side: `pairs` of them lie on either side of the axis, and with `middle` one more
/// lies on it. Beyond `walls` on each side the middle is not a bead but what is left for infill (`open`).
struct Count {
  int pairs = 0;
  bool middle = false;
  friend bool operator==(Count, Count) = default;
  int beads() const { return 2 * pairs + (middle ? 1 : 0); }
};

/// Number of beads for a thickness. `even`: pairs only, but for a single bead.
Count count_for(const Widths& widths, double thickness, bool even);

/// The thickness at which `less` beads become `less + 1`.
double threshold(const Widths& widths, int less);

/// How far from the outline beads lie at most: in the middle of what is thicker than twice that is room for infill.
double reach_of(const Widths& widths);

/// Bounds of the bands from the outline to the axis for a half thickness: pairs + 1 values, the first 0; without a
/// middle the last is the axis. Sum over both sides and the middle is the thickness.
void bounds_for(const Widths& widths, Count count, double half, double* bounds);

inline bool is_open(const Widths& widths, Count count) {
  return count.middle && count.pairs >= widths.walls;
}

}  // namespace weft::walls
