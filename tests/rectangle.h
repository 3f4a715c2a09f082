// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <stdexcept>

namespace weft::test {

/// A rectangle, from its corner with the smallest coordinates to that with the largest: the last two are no width and
/// depth.
inline Region rectangle(Point min, Point max) {
  if (min.x > max.x || min.y > max.y) throw std::invalid_argument("a rectangle's corners are the wrong way round");
  return {{min, {max.x, min.y}, max, {min.x, max.y}}, {}};
}
inline Region rectangle(Um x0, Um y0, Um x1, Um y1) {
  return rectangle({x0, y0}, {x1, y1});
}

}  // namespace weft::test
