// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/mesh.h"

#include <vector>

namespace weft::mesh {

/// Cuts a face of any number of corners into triangles, whose corners are indices into `corners`. A convex face becomes
/// a fan, another is cut ear by ear in the plane that shows it largest; one that crosses itself becomes a fan as well.
/// Post: corners.size() − 2 triangles, of the face's orientation and with its sides; none for fewer than three corners.
/// Cost: linear when convex, else at most about n² steps.
/// Source: Meisters 1975, "Polygons have ears".
std::vector<Triangle> triangulated(const std::vector<Point3>& corners);

}  // namespace weft::mesh
