// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/belts.h"
#include "infill/mask.h"
#include "infill/shells.h"
#include "infill/small_patches.h"

#include <optional>
#include <vector>

namespace weft::infill {

/// Cells over air, and how the strands, or lines, over them run.
struct Hanging {
  Mask area;
  double angle_rad = 0;
  bool ledge = false;  ///< as BridgeArea says
};

/// What each cell of a layer is filled with. Disjoint, and within `inside`.
struct Kinds {
  const Mask& inside;
  Mask top, solid;
  std::vector<Hanging> hanging;
  std::optional<Mask> sparse;  ///< present when any
  std::optional<Belts> belts;
};

/// The areas of a layer by its cells: along walls exactly, between two kinds of fill within a cell.
/// @param small which patches of sparse infill that bridges and belts leave become solid; nothing: none
LayerAreas exact_areas(const ShellLayer& layer, const Kinds& kinds, const SmallPatches* small);

}  // namespace weft::infill
