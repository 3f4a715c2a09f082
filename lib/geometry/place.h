// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cmath>

namespace weft::geometry {

/// A place in fractional microns relative to an origin, as MedialAxis::origin.
struct Place {
  double x = 0, y = 0;
};

inline double distance(Place a, Place b) {
  const double x = b.x - a.x, y = b.y - a.y;
  return std::sqrt(x * x + y * y);  // microns cannot overflow, which is what std::hypot is slower for
}
inline Place lerp(Place a, Place b, double t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

}  // namespace weft::geometry
