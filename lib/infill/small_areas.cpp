// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/small_areas.h"

#include <algorithm>
#include <cmath>

namespace weft::infill {

void thin_short_lines(double length_um, double angle_rad, std::size_t from, Beads& beads) {
  constexpr double aside = 0.1;  // sine: ends on microns turn short lines a little
  const double ux = std::cos(angle_rad), uy = std::sin(angle_rad);
  const auto share = [&](Point a, Point b) {  // 0: it is no line
    const double x = static_cast<double>(b.x) - a.x, y = static_cast<double>(b.y) - a.y, length = std::hypot(x, y);
    if (length == 0 || std::abs(x * uy - y * ux) > aside * length) return 0.0;
    return length / (length + length_um);
  };
  for (std::size_t i = from; i < beads.size(); ++i) {
    auto& path = beads[i].path;
    if (beads[i].role == Role::gap_fill || beads[i].closed) continue;
    for (std::size_t k = 0; k + 1 < path.size(); ++k) {
      const double kept = share(path[k].at, path[k + 1].at);
      if (kept == 0) continue;
      const auto whole = path[k].flow;
      path[k].flow = static_cast<float>(static_cast<double>(whole) * kept);
      path[k + 1].flow = static_cast<float>(static_cast<double>(path[k + 1].flow) * kept);
      ++k;  // its end is no beginning of another
    }
  }
}

}  // namespace weft::infill
