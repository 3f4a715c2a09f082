#pragma once
#include "geometry/medial_axis.h"

#include <algorithm>
#include <cmath>

/// Private to walls: what one does with places.
namespace weft::walls {

using geometry::Place;

inline double distance(Place a, Place b) {
  const double x = b.x - a.x, y = b.y - a.y;
  return std::sqrt(x * x + y * y);  // microns cannot overflow, which is what std::hypot is slower for
}
/// The direction from one place to another; none if they coincide.
inline Place unit(Place from, Place to) {
  const double d = std::max(1e-9, distance(from, to));
  return {(to.x - from.x) / d, (to.y - from.y) / d};
}
inline Place lerp(Place a, Place b, double t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}
inline double cross(Place a, Place b) {
  return a.x * b.y - a.y * b.x;
}
/// Twice the area of the triangle o, a, b; positive if it turns left.
inline double cross(Place o, Place a, Place b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

}  // namespace weft::walls
