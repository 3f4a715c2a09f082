// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"
#include "settings/groups/walls.h"
#include "walls/beading.h"

/// Private to walls: the walls of one region of a layer.
namespace weft::walls {

/// What is not laid because it is thinner than any bead.
struct LeftOut {
  double mm = 0;       ///< its length
  double most_mm = 0;  ///< of the longest stretch of it
  Point at;            ///< the middle of that stretch
  void add(double stretch_mm, Point middle) { add({stretch_mm, stretch_mm, middle}); }
  void add(const LeftOut& other) {
    mm += other.mm;
    if (other.most_mm > most_mm) most_mm = other.most_mm, at = other.at;
  }
};

struct Part {
  Beads beads;        ///< in no order yet
  Regions inside;     ///< what walls leave for infill
  LeftOut left_out;   ///< what was too thin to be laid
  bool valid = true;  ///< false: there was no medial axis to go by, and walls are concentric
};

/// Pre: a region as slicing makes it, on the lattice. `nozzle`: its diameter, µm. `index`: the region's number in its
/// layer, which its beads bear. Never nothing for want of a medial axis: see `valid`. @throws Stopped when asked to
/// stop
Part part_of(const WallSettings& settings, const Widths& widths, const Region& region, Um nozzle, std::uint32_t index);

}  // namespace weft::walls
