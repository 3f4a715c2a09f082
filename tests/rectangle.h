#pragma once
#include "core/polygon.h"

namespace weft::test {

/// A rectangle, from its corner with the smallest coordinates to that with the largest.
inline Region rectangle(Point min, Point max) {
  return {{min, {max.x, min.y}, max, {min.x, max.y}}, {}};
}
inline Region rectangle(Um x0, Um y0, Um x1, Um y1) {
  return rectangle({x0, y0}, {x1, y1});
}

}  // namespace weft::test
