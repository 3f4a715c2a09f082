// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/fits.h"

#include "core/convex_hull.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace weft::mesh {
namespace {

double distance_to_segment(Point p, Point a, Point b) {
  const double along = static_cast<double>(dot(p - a, b - a)), length2 = static_cast<double>(distance2(a, b));
  if (along <= 0) return distance(p, a);
  if (along >= length2) return distance(p, b);
  return std::abs(static_cast<double>(orient(a, b, p))) / std::sqrt(length2);
}

}  // namespace

double outside_by(Point p, const Ring& ring) {
  if (side_of(ring, p) != Side::outside) return 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i)
    nearest = std::min(nearest, distance_to_segment(p, ring[i], ring[(i + 1) % ring.size()]));
  return nearest;
}

bool cuts(Point a, Point b, std::span<const Point> convex_shape) {
  // Two convex sets have no inner point in common when a line through a side of one of them separates them.
  bool left = false, right = false;
  for (const Point p : convex_shape) {
    const std::int64_t side = orient(a, b, p);
    left |= side > 0;
    right |= side < 0;
  }
  if (a != b && !(left && right)) return false;
  for (std::size_t i = 0; i < convex_shape.size(); ++i) {
    const Point from = convex_shape[i], to = convex_shape[(i + 1) % convex_shape.size()];
    if (orient(from, to, a) <= 0 && orient(from, to, b) <= 0) return false;
  }
  return convex_shape.size() > 2;
}

bool lies_in(std::span<const Point> convex_shape, const Ring& ring) {
  for (const Point p : convex_shape)
    if (side_of(ring, p) == Side::outside) return false;
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (cuts(ring[i], ring[(i + 1) % ring.size()], convex_shape)) return false;
  return true;
}

bool overlap(std::span<const Point> convex_shape, const Ring& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (cuts(ring[i], ring[(i + 1) % ring.size()], convex_shape)) return true;
  // No side of the ring enters the shape: they are apart, or one lies in the other.
  if (std::any_of(convex_shape.begin(), convex_shape.end(), [&](Point p) { return side_of(ring, p) == Side::inside; }))
    return true;
  if (std::any_of(ring.begin(), ring.end(), [&](Point p) { return strictly_inside(p, convex_shape); })) return true;
  // Left is a shape whose corners all lie on the ring: it is inside when its middle is.
  std::int64_t x = 0, y = 0;
  for (const Point p : convex_shape) x += p.x, y += p.y;
  const auto n = static_cast<std::int64_t>(convex_shape.size());
  return n > 2 && side_of(ring, {static_cast<Um>(x / n), static_cast<Um>(y / n)}) == Side::inside;
}

}  // namespace weft::mesh
