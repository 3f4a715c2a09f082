// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/strips.h"

#include "geometry/offset.h"

#include <cmath>

namespace weft::infill {

std::optional<double> angle_along_strip(const Region& region, Um band) {
  constexpr double widest = 3.5;    // bands
  constexpr double straight = 0.8;  // of the edge's length that runs one way, less what runs across it
  double all = 0, x = 0, y = 0;     // the direction of each edge at twice its angle: there and back are one
  const auto look = [&](const Ring& ring) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const double dx = ring[i].x - ring[j].x, dy = ring[i].y - ring[j].y, l = std::hypot(dx, dy);
      if (l == 0) continue;
      all += l, x += (dx * dx - dy * dy) / l, y += 2 * dx * dy / l;
    }
  };
  look(region.outer);
  for (const Ring& hole : region.holes) look(hole);
  if (all == 0 || 2e6 * area_mm2(region) > widest * band * all || std::hypot(x, y) < straight * all)
    return std::nullopt;
  return std::atan2(y, x) / 2;
}

bool is_strip(const Region& region, Um band) {
  constexpr double widest = 3.5;       // bands, as belts and straight strips
  constexpr double least_long = 6.25;  // edge² / 4 areas: of a strip four times as long as wide
  double edge = perimeter_of(region.outer);
  for (const Ring& hole : region.holes) edge += perimeter_of(hole);
  const double area = 1e6 * area_mm2(region);
  if (2 * area > widest * band * edge || edge * edge < 4 * least_long * area) return false;
  return geometry::offset({region}, {.by = -rounded(widest / 2 * band)}).empty();
}

}  // namespace weft::infill
