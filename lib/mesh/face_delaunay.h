// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/point.h"
#include "mesh/mesh.h"

#include <optional>
#include <vector>

namespace weft::mesh {

/// Cuts a face of many corners into triangles in n log n steps: by the constrained Delaunay triangulation of its sides,
/// of which the triangles inside are taken. It may touch itself, and have holes that a side leads to and back from.
/// @param ring the corners as they are seen, counter-clockwise; where two are seen at one place, either may be named
/// @return ring.size() − 2 triangles of indices into `ring`, counter-clockwise; nothing for a face that crosses itself
/// Source: Chew 1989, "Constrained Delaunay triangulations"; CGAL's 2D triangulations.
std::optional<std::vector<Triangle>> triangulated_by_delaunay(const std::vector<Point>& ring);

/// The same of several rings that do not cross: what lies in an odd number of them.
/// @return triangles of indices into the corners of all rings one behind the other; nothing where two sides cross
std::optional<std::vector<Triangle>> triangulated_rings(const std::vector<std::vector<Point>>& rings);

}  // namespace weft::mesh
