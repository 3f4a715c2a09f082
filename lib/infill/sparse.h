// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "model/bead.h"
#include "settings/groups/infill.h"

#include <cstddef>

namespace weft::infill {

/// How an area is filled sparsely.
struct SparseStyle {
  InfillPattern pattern = InfillPattern::grid;
  double density = 0.2;  ///< share of the area, 0 < density < 1
  Um band = 0;
  double angle_rad = 0;
  double overlap_um = 0;  ///< how far lines reach over the edge
  bool connect = true;
  bool turned_layer = false;  ///< every second layer: the pattern `lines` is turned by 90°
  Um z = 0;
  Point origin{};  ///< patterns are anchored here, so that layers stand on each other
  int layers = 1;  ///< printed at once: as much higher are the beads
  std::uint32_t part = 0;
};

/// Of a layer: where it is, and the nozzle's diameter.
struct SparseLayer {
  std::size_t index = 0;
  Um z = 0, height = 0, nozzle = 0;
  Point origin{};
};
/// Of a line of sparse infill.
Um width_of_sparse(const InfillSettings& infill, Um nozzle, Um height);
/// As the settings ask for it, without overlap.
SparseStyle sparse_style(const InfillSettings& infill, const SparseLayer& layer);

/// Fills a region with the pattern. Lines that are neighbours along the edge are joined by a bead beside the edge; all
/// beads are then narrowed a little, so that the joints do not raise the density.
void fill_sparse(const Region& region, const SparseStyle& style, Beads& beads);

}  // namespace weft::infill
