// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "core/polygon.h"
#include "model/bead.h"
#include "settings/groups/adhesion.h"

#include <span>
#include <vector>

namespace weft::adhesion {

/// A layer of the whole plate: the outlines of all objects, where they will be printed.
struct PlateLayer {
  Regions outlines;
  Um height = 0;
};

/// What of the first layer has a brim of its own.
struct Foot {
  Regions outlines;
  AdhesionSettings settings;  ///< of its brim
};

struct AdhesionInput {
  std::span<const PlateLayer> layers;   ///< from the first on; as many as `layers_needed` says, or all there are
  Um nozzle = 0;                        ///< diameter
  const Ring* print_surface = nullptr;  ///< what adhesion_outside = clip cuts to; none: nothing is cut
  std::span<const Foot> feet{};         ///< of the first layer; empty: all of it is as the settings say
};

/// How many layers a skirt looks at and is printed on.
std::size_t layers_needed(const AdhesionSettings& settings);

struct Adhesion {
  std::vector<Beads>
      layers;  ///< by layer, to be printed before everything else in their order; may be shorter than the print
  Notices notices;
};

/// Skirt around everything and brim along the outlines of the first layer.
/// Post:  loops come from the outside in, so the brim's last loop ends at the part. The brim's bands fill its width,
/// beginning
///        brim_gap from the part; loops that run into another part are opened there. The skirt's innermost band is
///        skirt_gap away from parts and brim. A bead's sequence is that of the group of parts that it surrounds.
/// Cost:  an offset of the outlines for each loop.
Adhesion build(const AdhesionSettings& settings, const AdhesionInput& input);

}  // namespace weft::adhesion
