// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace weft::geometry {

/// Triangles between points, as indices of theirs, counter-clockwise: no point lies inside of the circle through the
/// corners of a triangle. Of points that are equal the first counts; of points in a line there are no triangles.
/// Law: the same points in the same order give the same triangles, moved or not. Cost: about 1 µs a point.
/// Source: CGAL's 2D triangulations, exact predicates.
std::vector<std::array<std::size_t, 3>> delaunay(std::span<const Point> points);

}  // namespace weft::geometry
