// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/cube_tree.h"
#include "infill/density.h"
#include "infill/direction.h"
#include "infill/shells.h"

#include <optional>
#include <vector>

namespace weft::infill {

/// What sparse infill knows of the whole object: found once, read by all layers.
struct Prepared {
  Um band = 0;  ///< of a line in all layers, however high they are: what lines' distances go by
  std::optional<CubeTree> cubes;
  double cubes_angle_rad = 0;                   ///< how they are turned, in all layers
  std::vector<std::vector<Polyline>> branches;  ///< of lightning, by layer
  std::optional<Density> density;
  std::optional<Direction> direction;
};

/// @param areas   of all layers
/// @param origin  where patterns are anchored
/// @param on_bed  what is added to the object's places to have those on the bed
/// @throws as Density
Prepared prepare(const InfillSettings& infill, const ShellObject& object, const std::vector<LayerAreas>& areas,
                 Point origin, Point on_bed);

}  // namespace weft::infill
