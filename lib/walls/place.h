// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/medial_axis.h"

#include <algorithm>
#include <cmath>
#include <optional>

/// Private to walls: what one does with places.
namespace weft::walls {

using geometry::distance;
using geometry::lerp;
using geometry::Place;

/// The direction from one place to another; none if they coincide.
inline Place unit(Place from, Place to) {
  const double d = std::max(1e-9, distance(from, to));
  return {(to.x - from.x) / d, (to.y - from.y) / d};
}
inline double cross(Place a, Place b) {
  return a.x * b.y - a.y * b.x;
}
/// Twice the area of the triangle o, a, b; positive if it turns left.
inline double cross(Place o, Place a, Place b) {
  return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
}

/// Of the places u and v on either side of a line from 0 in the direction `way` (a unit), du = cross(way, u) and
/// dv = cross(way, v) off it: where between them it runs, as the distance from 0, negative behind it.
inline double meeting(Place way, Place u, double du, Place v, double dv) {
  const double t = du / (du - dv);
  return way.x * (u.x + t * (v.x - u.x)) + way.y * (u.y + t * (v.y - u.y));
}

/// Where the line from p in the direction `way` (a unit) meets the segment from a to b: the distance from p, negative
/// behind it.
inline std::optional<double> meets(Place p, Place way, Place a, Place b) {
  const Place u{a.x - p.x, a.y - p.y}, v{b.x - p.x, b.y - p.y};
  const double du = cross(way, u), dv = cross(way, v);
  if ((du < 0) == (dv < 0)) return {};
  return meeting(way, u, du, v, dv);
}

}  // namespace weft::walls
