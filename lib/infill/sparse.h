// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "infill/overlap.h"
#include "model/bead.h"
#include "settings/groups/infill.h"

#include <cstddef>

namespace weft::infill {

struct Prepared;

/// How an area is filled sparsely.
struct SparseStyle {
  InfillPattern pattern = InfillPattern::grid;
  double density = 0.2;  ///< share of the area, 0 < density < 1
  Um band = 0;
  double angle_rad = 0;
  Overlap overlap{};
  bool connect = true;
  Um z = 0;
  Point origin{};  ///< patterns are anchored here, so that layers stand on each other
  int layers = 1;  ///< printed at once: as much higher are the beads
  std::uint32_t part = 0;
  std::size_t index = 0;               ///< of the layer
  std::size_t turn = 0;                ///< the same, for patterns that are turned from layer to layer
  bool turned = true;                  ///< they are; else `angle_rad` holds as it is
  double reach = 0;                    ///< no layer of the object is farther from the origin along an axis; 0: unknown
  double anchor_max = -1;              ///< longest joint, µm; negative: by the distance of the lines
  double anchor_um = 0;                ///< how far ends without a joint are bent along the edge
  int loops = 0;                       ///< lines around the area
  int multiplier = 1;                  ///< lines side by side for each of the pattern
  bool even = true;                    ///< lines of a small region are as wide as its density asks for, not as usual
  bool bend = false;                   ///< lines of two directions turn where they meet, and none crosses another
  bool alone = false;                  ///< no wall holds the lines, only their joints: laid whatever they take
  const Prepared* prepared = nullptr;  ///< of the object, for patterns that look at all of it
};

/// Of a layer, or of layers printed at once: where they are, and the nozzle's diameter.
struct SparseLayer {
  std::size_t index = 0, turn = 0;
  Um z = 0, height = 0, nozzle = 0;
  Point origin{};
  double reach = 0;
  double turned_rad = 0;  ///< of the object, against its file
};
/// Of a line of sparse infill.
Um width_of_sparse(const InfillSettings& infill, Um nozzle, Um height);
/// As the settings ask for it, without overlap.
SparseStyle sparse_style(const InfillSettings& infill, const SparseLayer& layer);

/// Fills a region with the pattern. Lines that are neighbours along the edge are joined by a bead beside the edge; all
/// beads are then narrowed a little, so that the joints do not raise the density.
void fill_sparse(const Region& region, const SparseStyle& style, Beads& beads);

/// What of a region is as dense as that, or denser.
struct DenseLevel {
  double density = 0;
  Regions within;
};

/// Fills a region whose density doubles from level to level with lines of several directions: those of a level run on
/// through all that is denser, and lines between them end at lines that they meet.
/// Pre: levels from the least dense, which is all of the region; each is twice as dense as the one before
/// @returns false, and lays nothing, where lines of the pattern at a density are none of those at its double
bool fill_levels(const Region& region, const SparseStyle& style, const std::vector<DenseLevel>& levels, Beads& beads);

}  // namespace weft::infill
