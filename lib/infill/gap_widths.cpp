// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/gap_widths.h"

#include <algorithm>
#include <cmath>

namespace weft::infill {

void follow_gaps(const std::function<double(Point)>& gap, double apart_um, std::size_t from, Beads& beads) {
  double before = 0, after = 0;
  for (std::size_t b = from; b < beads.size(); ++b) before += volume_mm3(beads[b], 1000);
  for (std::size_t b = from; b < beads.size(); ++b) {
    const std::vector<Junction>& old = beads[b].path;
    std::vector<Junction> path;
    for (std::size_t i = 0; i < old.size(); ++i) {
      path.push_back(old[i]);
      if (i + 1 == old.size() && !beads[b].closed) break;
      const Junction &a = old[i], &c = old[(i + 1) % old.size()];
      const int pieces = static_cast<int>(std::ceil(distance(a.at, c.at) / apart_um));
      for (int k = 1; k < pieces; ++k) {
        const double t = static_cast<double>(k) / pieces;
        path.push_back(
            {{rounded(std::lerp(a.at.x, c.at.x, t)), rounded(std::lerp(a.at.y, c.at.y, t))}, a.width, a.flow});
      }
    }
    for (Junction& j : path) j.width = std::max(1, rounded(j.width * gap(j.at)));
    beads[b].path = std::move(path);
    after += volume_mm3(beads[b], 1000);
  }
  if (after <= 0) return;
  for (std::size_t b = from; b < beads.size(); ++b)
    for (Junction& j : beads[b].path) j.width = std::max(1, rounded(j.width * before / after));
}

}  // namespace weft::infill
