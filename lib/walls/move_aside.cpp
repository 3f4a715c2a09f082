// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/move_aside.h"

#include "walls/place.h"

#include <vector>

namespace weft::walls {
namespace {

/// To the left of the way from a to b.
Place left_of(Point a, Point b) {
  const Place way = unit({0, 0}, {static_cast<double>(b.x - a.x), static_cast<double>(b.y - a.y)});
  return {-way.y, way.x};
}

}  // namespace

void move_left(Bead& bead, std::span<const double> by) {
  const std::size_t n = bead.path.size();
  const auto old = bead.path;
  for (std::size_t j = 0; j < n; ++j) {
    if (by[j] == 0) continue;
    const Place u = left_of(old[(j + n - 1) % n].at, old[j].at), v = left_of(old[j].at, old[(j + 1) % n].at);
    const Place both{u.x + v.x, u.y + v.y};
    const double length = distance({0, 0}, both);
    if (length < 1e-3) continue;  // there and back: either side is as good
    bead.path[j].at = old[j].at + Point{rounded(by[j] * both.x / length), rounded(by[j] * both.y / length)};
  }
}

}  // namespace weft::walls
