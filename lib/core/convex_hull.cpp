// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/convex_hull.h"

#include <algorithm>

namespace weft {
namespace {

/// Counter-clockwise, without collinear points.
Ring chains(std::vector<Point> points) {
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  Ring hull;
  const auto add_chain = [&](auto first, auto last) {
    const std::size_t base = hull.size();
    for (; first != last; ++first) {
      while (hull.size() >= base + 2 && orient(hull[hull.size() - 2], hull.back(), *first) <= 0) hull.pop_back();
      hull.push_back(*first);
    }
    hull.pop_back();  // it begins the other chain
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

}  // namespace

Ring convex_hull(std::vector<Point> points) {
  constexpr std::size_t many = 64;
  if (points.size() > many) {
    Outermost outermost;
    for (const Point p : points) outermost.add(p);
    std::erase_if(points, [octagon = outermost.octagon()](Point p) { return strictly_inside(p, octagon); });
  }
  return chains(std::move(points));
}

bool is_convex(const Ring& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (orient(ring[i], ring[(i + 1) % ring.size()], ring[(i + 2) % ring.size()]) < 0) return false;
  return true;
}

}  // namespace weft
