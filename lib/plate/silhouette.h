// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "mesh/mesh.h"

#include <span>

namespace weft::plate {

/// What the meshes cover seen from above. The edges between triangles that face up and those that do not enclose, by
/// winding number, just what some triangle that faces up covers. Of an open mesh: about. Cost: a union of those edges.
Regions silhouette_of(std::span<const Mesh> meshes);

}  // namespace weft::plate
