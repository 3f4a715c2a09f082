#pragma once
#include "model/bead.h"
#include "settings/walls.h"
#include "walls/trace.h"

/// Private to walls: from lines in fractional microns to beads on the lattice.
namespace weft::walls {

struct FinishOptions {
  Point origin;  ///< of the lines
  std::uint32_t part = 0;
  double least_feature = 50;                      ///< thinner stretches are cut out, µm
  double least_length = 100;                      ///< shorter open beads are dropped, µm
  bool compensate = true;                         ///< flow compensation
  double stable_outer = 200, stable_inner = 200;  ///< narrowest planned width, µm
  double most_width = 1e9;                        ///< no bead is wider, µm
  double least_flow = 0.05, most_flow = 1;
};

/// Appends the beads of a line; `dropped_mm` grows by the length that was left out.
void finish(Line line, const FinishOptions& options, Beads& out, double& dropped_mm);

/// Puts the beads of one part in printing order.
void put_in_order(Beads& beads, WallOrder order);

}  // namespace weft::walls
