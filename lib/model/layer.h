// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "core/polygon.h"
#include "model/bead.h"

#include <string>
#include <vector>

namespace weft {

/// A slice of one object: what is solid between z − height and z.
struct SlicedLayer {
  Um z = 0;       ///< top of the layer: where the nozzle is while printing it
  Um height = 0;  ///< of this layer
  Regions regions;
};

/// A notice, and where on the object; its message does not tell the place.
struct PlacedNotice {
  std::string code, message;
  Point at;
  friend bool operator==(const PlacedNotice&, const PlacedNotice&) = default;
};

/// Walls of one layer.
struct WallLayer {
  Beads beads;
  Regions inside;    ///< what the walls leave for skin and infill, up to the inner edge of the innermost walls
  Regions over_air;  ///< where nothing lies below, as the caller knows it
  std::vector<PlacedNotice> notices;
};

/// Skin and infill of one layer.
struct FillLayer {
  Beads beads;
  Notices notices;
};

}  // namespace weft
