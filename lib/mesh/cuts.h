// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/mesh.h"

#include <cstdint>
#include <vector>

namespace weft::mesh {

/// Whether an edge of one set of a mesh's triangles passes through a triangle of another: surfaces that only touch, or
/// lie in each other's planes, do not cut.
/// Cost: n log n for what of the two lies in the box of both, and n² where all of it lies at the same X.
bool cut_each_other(const Mesh& mesh, const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b);

}  // namespace weft::mesh
