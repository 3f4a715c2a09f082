// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"
#include "settings/groups/walls.h"
#include "walls/beading.h"

/// Private to walls: the walls of one region of a layer.
namespace weft::walls {

struct Part {
  Beads beads;            ///< in no order yet
  Regions inside;         ///< what walls leave for infill
  double dropped_mm = 0;  ///< length of what was too thin to be laid
  bool valid = true;      ///< false: there was no medial axis to go by, and walls are concentric
};

/// Pre: a region as slicing makes it, on the lattice. `nozzle`: its diameter, µm. `index`: the region's number in its
/// layer, which its beads bear. Never nothing for want of a medial axis: see `valid`. @throws Stopped when asked to
/// stop
Part part_of(const WallSettings& settings, const Widths& widths, const Region& region, Um nozzle, std::uint32_t index);

}  // namespace weft::walls
