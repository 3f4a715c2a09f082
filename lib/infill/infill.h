// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "infill/prepared.h"
#include "infill/shells.h"
#include "model/layer.h"
#include "settings/groups/infill.h"
#include "settings/groups/shells.h"

#include <cstddef>
#include <functional>
#include <span>

namespace weft::infill {

/// What one layer is filled from, besides settings.
struct FillInput {
  const LayerAreas& areas;
  std::size_t index = 0;  ///< of the layer: directions alternate by it, but those of long tops
  Um z = 0;               ///< top of the layer: patterns that change with height
  Um height = 0;
  Um nozzle = 0;                                ///< diameter
  double overlap_factor = 1;                    ///< how far lines side by side overlap (model/flow.h)
  Um wall_line_width = 0;                       ///< of inner walls; what a share of overlap is of. 0: automatic
  Um outer_wall_line_width = 0;                 ///< 0: automatic
  int wall_count = 3;                           ///< around what is filled; ends of lines stay within the outermost
  Point origin{};                               ///< where patterns are anchored: one point for all layers of an object
  double turned_rad = 0;                        ///< of the object, against its file
  Um reach = 0;                                 ///< how far the object goes from there, along either axis
  const Prepared* prepared = nullptr;           ///< of the object (infill/prepared.h)
  bool topmost = false;                         ///< no layer lies above
  const Regions* above = nullptr;               ///< the slice of the layer above, if there is one: it covers tops
  std::span<const BridgeArea> bridges_below{};  ///< of the layer below: solid lines cross their strands
  /// Fills an area with lines along its edge, about as far apart as it says (µm), that are together as wide as the area
  /// is everywhere; absent: none is filled so.
  std::function<Beads(const Region&, Um band)> along_edge{};
};

/// Lays beads in the areas: sparse ones in the pattern, skin and solid ones as lines that fill the area's width
/// exactly, in an order that never leaves a line between two printed ones (monotonic), bridges as free strands.
/// Strips that bend get lines along their edge: across it they would be dabs with a turn between each two.
/// Post: volume of solid beads = area × height, of sparse ones the same times the density; beads stay within the areas,
///       but for ends of lines and what joins them along the edge, which reach over it by the overlap. Bead::part is
///       that of the area. A solid region's beads share a `sequence`.
/// Cost: 7 to 13 µs a bead (tests/benchmark/RESULTS.md).
FillLayer fill(const InfillSettings& infill, const ShellSettings& shells, const FillInput& input);

/// What of the settings cannot have the effect the user may expect.
/// @param height of the layers
Notices check(const InfillSettings& infill, Um nozzle_diameter, Um height);

}  // namespace weft::infill
