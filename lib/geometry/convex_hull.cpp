#include "geometry/convex_hull.h"

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

/// What lies within the octagon of the outermost points is no corner, and need not be sorted. Source: Akl & Toussaint
/// 1978, "A fast convex hull algorithm".
void drop_inner(std::vector<Point>& points) {
  const auto along = [](Point p, int direction) -> std::int64_t {
    switch (direction) {
      case 0:
        return p.x;
      case 1:
        return std::int64_t{p.x} + p.y;
      case 2:
        return p.y;
      default:
        return std::int64_t{p.y} - p.x;
    }
  };
  std::vector<Point> outermost(8, points.front());
  for (const Point p : points)
    for (int d = 0; d < 4; ++d) {
      Point &most = outermost[static_cast<std::size_t>(d)], &least = outermost[static_cast<std::size_t>(d + 4)];
      if (along(p, d) > along(most, d)) most = p;
      if (along(p, d) < along(least, d)) least = p;
    }
  const Ring octagon = chains(std::move(outermost));
  if (octagon.size() < 3) return;
  std::erase_if(points, [&](Point p) {
    for (std::size_t i = 0; i < octagon.size(); ++i)
      if (orient(octagon[i], octagon[i + 1 == octagon.size() ? 0 : i + 1], p) <= 0) return false;
    return true;
  });
}

}  // namespace

Ring convex_hull(std::vector<Point> points) {
  constexpr std::size_t many = 64;
  if (points.size() > many) drop_inner(points);
  return chains(std::move(points));
}

}  // namespace weft
