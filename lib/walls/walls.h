// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/layer.h"
#include "settings/groups/walls.h"

#include <cstddef>

namespace weft::walls {

/// What walls are built from, besides their settings.
struct WallInput {
  const SlicedLayer& layer;
  std::size_t index = 0;        ///< of the layer in its object: extra walls alternate by it
  Um nozzle_diameter = 0.4_mm;  ///< what automatic widths and shares are measured against
  const Regions* over_air =
      nullptr;  ///< where nothing lies below, if the caller knows; there beads keep the nozzle's own strand
  const Regions* above = nullptr;                ///< outlines of the layer above; null: it is the last one
  const WallSettings* settings_above = nullptr;  ///< that hold there; absent: the same
  Point origin{};                                ///< of the object, with which the noise of rough walls moves
};

/// Lays beads along the outlines of one layer, widening or narrowing them so that no gap is left.
/// Post:   the bands cover `layer.regions` (moved by the xy offsets) less `inside`; beads of a part follow each other
///         in the order they are printed; Bead::part is the index of the region they lie in.
/// Throws: nothing on odd geometry: what could not be printed is a notice.
/// Cost:   O(n log n) in the vertices, 6 to 10 µs a vertex (tests/benchmark/RESULTS.md).
/// Source: Kuipers et al. 2020, "A framework for adaptive width control of dense contour-parallel toolpaths in fused
///         deposition modeling"; widths are bands (model/flow.h).
WallLayer build(const WallSettings& settings, const WallInput& input);

/// `build` in two steps, where it is not known at once what lies below: all that does not hang on input.over_air, and
/// then the rest. Pre: `finish` gets the settings and the input of `lay`, but for over_air, and what that made; once.
WallLayer lay(const WallSettings& settings, const WallInput& input);
void finish(const WallSettings& settings, const WallInput& input, WallLayer& laid);

/// The outlines of a layer, moved by the xy offsets: what `build` lays beads within. Regions may be joined, divided or
/// lost thereby.
Regions outlines_of(const WallSettings& settings, const WallInput& input);

/// Does any offset move outlines there? If not, `outlines_of` gives them as they are.
/// @param above that hold on layers above the first
bool moves_outlines(const WallSettings& settings, const WallSettings& above);

/// What of the settings cannot have the effect the user may expect.
/// @param height of the layers
Notices check(const WallSettings& settings, Um nozzle_diameter, Um height);

}  // namespace weft::walls
