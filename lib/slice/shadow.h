// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "mesh/mesh.h"
#include "slice/slice.h"

#include <span>
#include <vector>

namespace weft::slice {

/// What facets of a surface cover of each layer, seen from above: of layer i, what of them lies between the cut of the
/// layer below and its own. So facets that face down cover there what layer i reaches beyond layer i − 1.
/// Pre: planes ascend. Cost: linear in the facets and the layers that each one crosses.
std::vector<Regions> shadows(const Mesh& facets, std::span<const Plane> planes);

}  // namespace weft::slice
