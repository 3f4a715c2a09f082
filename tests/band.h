// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"

#include <cmath>
#include <cstddef>

namespace weft::test {

/// Whether the band of a bead lies over a place, µm. Bands end square; where they turn they are round.
inline bool covers(const Bead& bead, double x, double y) {
  const std::size_t segments = bead.path.size() - (bead.closed ? 0 : 1);
  for (std::size_t i = 0; i < segments; ++i) {
    const Junction &a = bead.path[i], &b = bead.path[(i + 1) % bead.path.size()];
    const double px = x - a.at.x, py = y - a.at.y;
    if ((i > 0 || bead.closed) && std::hypot(px, py) <= a.width / 2.0) return true;
    const double dx = b.at.x - a.at.x, dy = b.at.y - a.at.y, length = std::hypot(dx, dy);
    if (length == 0) continue;
    const double along = (px * dx + py * dy) / length, off = std::abs(px * dy - py * dx) / length;
    if (along >= 0 && along <= length && off <= (a.width + (b.width - a.width) * along / length) / 2) return true;
  }
  return false;
}

}  // namespace weft::test
