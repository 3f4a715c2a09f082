// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/mesh.h"

#include <vector>

namespace weft::mesh {

/// Cuts a face of any number of corners into triangles, whose corners are indices into `corners`. A convex face becomes
/// a fan, another is cut ear by ear in the plane that shows it largest, or by its Delaunay triangulation there when it
/// has many corners; one that crosses itself becomes a fan as well.
/// Post: corners.size() − 2 triangles, of the face's orientation and with its sides; none for fewer than three corners.
/// Cost: linear when convex, else n log n.
/// Source: Meisters 1975, "Polygons have ears".
std::vector<Triangle> triangulated(const std::vector<Point3>& corners);

}  // namespace weft::mesh
