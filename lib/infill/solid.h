// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "infill/overlap.h"
#include "model/bead.h"

namespace weft::infill {

/// How an area is filled with lines side by side.
struct SolidStyle {
  Role role = Role::solid_infill;
  Um band = 0;                ///< of a line; adapted a little so that whole lines fill the width
  double angle_rad = 0;       ///< direction of the lines, against X
  Overlap overlap{};          ///< of ends of lines, and of turns there; sides do not reach over the edge
  bool connect = true;        ///< neighbouring lines are one bead where they can
  bool fixed_strand = false;  ///< keep `band` as the width of each line (bridges)
  double flow = 1;
  Point origin{};
  bool turned = true;        ///< by 90° on every second layer
  bool ends_within = false;  ///< ends of lines that do not turn keep half a line off the edge, as turns do
  bool gaps = true;          ///< strips narrower than a line and a half are filled
  bool ordered = true;       ///< lines are printed one after the other, also where another order is shorter
  std::uint32_t part = 0, sequence = 0;
};

/// Fills a region with parallel lines, in an order in which every line is printed after its neighbour on one and the
/// same side. Neighbouring lines are joined by a turn along the edge; both are shortened by half of it, so that the
/// turn adds no plastic. Strips narrower than a line and a third get one bead along their axis as wide as they are
/// (Role::gap_fill; of a bridge a strand of it) where that is a quarter of a line at least, or none without `gaps`.
/// Post: Σ volume = area × height × flow, but for what overlaps and for what stays open.
void fill_solid(const Region& region, const SolidStyle& style, Beads& beads);

}  // namespace weft::infill
