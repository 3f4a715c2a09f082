// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"
#include "settings/groups/walls.h"
#include "walls/part.h"
#include "walls/trace.h"

/// Private to walls: from lines in fractional microns to beads on the lattice.
namespace weft::walls {

struct FinishOptions {
  Point origin;  ///< of the lines
  std::uint32_t part = 0;
  double least_feature = 50;                      ///< thinner stretches are cut out, µm
  double least_length = 100;                      ///< shorter open beads are dropped, µm; 0: none
  double least_area = 0;                          ///< … and those that are too thin and lay less, µm²
  bool has_walls = false;                         ///< the part has walls: single beads on its outline fill tips of it
  bool compensate = true;                         ///< flow compensation
  double stable_outer = 200, stable_inner = 200;  ///< narrowest planned width, µm
  double most_width = 1e9;                        ///< no bead is wider, µm
  double least_flow = 0.05, most_flow = 1;
  /// A width that is held for less is left out (model/widths), µm: of outer walls, of inner loops, and of what is open
  /// between them.
  double steady_outer = 0, steady_loop = 0, steady_open = 0;
};

/// Whether an open bead of that length and area is worth its two travels: what is too short is not, nor what lays less
/// than oozes on the way where it is thinner than 0.1 mm or the tip of a part that has walls. What a part without walls
/// consists of stays, and so does what closes the gaps between walls.
inline bool worth_a_bead(const FinishOptions& o, bool tip, double length_um, double area_um2) {
  constexpr double thin_um = 100;
  if (length_um < o.least_length) return false;
  return o.least_length == 0 || area_um2 >= o.least_area || (!tip && area_um2 >= thin_um * length_um);
}

/// Appends what is laid of a line, in the direction in which it is, and adds what is not to `left_out`.
void finish(Line line, const FinishOptions& options, std::vector<Line>& out, LeftOut& left_out);

/// Appends the bead of a finished line, on the lattice; none if its points are one.
void append_bead(const Line& line, const FinishOptions& options, Beads& out);

/// Puts the beads of one part in printing order.
void put_in_order(Beads& beads, WallOrder order);

}  // namespace weft::walls
