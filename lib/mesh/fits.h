// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <span>

/// Exact questions about shapes on a plate. Everything that only touches is inside, and outside of what is kept out.
namespace weft::mesh {

/// How far p is outside the ring, fractional microns; 0 when it is in or on it.
double outside_by(Point p, const Ring& ring);

/// Whether the segment ab has a point inside the convex shape. Pre: `shape` is counter-clockwise.
bool cuts(Point a, Point b, std::span<const Point> convex_shape);

/// Whether the convex shape lies in the ring. O(shape × ring).
bool lies_in(std::span<const Point> convex_shape, const Ring& ring);

/// Whether the convex shape and the ring have inner points in common. O(shape × ring).
bool overlap(std::span<const Point> convex_shape, const Ring& ring);

}  // namespace weft::mesh
