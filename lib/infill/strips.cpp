// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/strips.h"

#include "geometry/offset.h"

#include <cmath>

namespace weft::infill {

namespace {

double edge_um(const Region& region) {
  double um = perimeter_of(region.outer);
  for (const Ring& hole : region.holes) um += perimeter_of(hole);
  return um;
}

}  // namespace

EdgeDirection direction_of_edge(const Region& region) {
  struct Sum {
    double x = 0, y = 0;
    void add(double by_x, double by_y) { x += by_x, y += by_y; }
  } by_length, by_square;  // each edge at twice its angle: there and back are one
  double all = 0;
  const auto look = [&](const Ring& ring) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const double dx = ring[i].x - ring[j].x, dy = ring[i].y - ring[j].y, l = std::hypot(dx, dy);
      if (l == 0) continue;
      const double x = dx * dx - dy * dy, y = 2 * dx * dy;
      all += l, by_length.add(x / l, y / l), by_square.add(x, y);
    }
  };
  look(region.outer);
  for (const Ring& hole : region.holes) look(hole);
  if (all == 0) return {};
  return {std::atan2(by_square.y, by_square.x) / 2, std::hypot(by_length.x, by_length.y) / all};
}

std::optional<double> angle_along_strip(const Region& region, Um band) {
  constexpr double widest = 3.5;    // bands
  constexpr double straight = 0.8;  // of the edge
  if (2e6 * area_mm2(region) > widest * band * edge_um(region)) return std::nullopt;
  const EdgeDirection edge = direction_of_edge(region);
  return edge.share < straight ? std::nullopt : std::optional(edge.angle_rad);
}

bool is_strip(const Region& region, Um band) {
  constexpr double widest = 3.5;       // bands, as belts and straight strips
  constexpr double least_long = 6.25;  // edge² / 4 areas: of a strip four times as long as wide
  const double edge = edge_um(region), area = 1e6 * area_mm2(region);
  if (2 * area > widest * band * edge || edge * edge < 4 * least_long * area) return false;
  return geometry::offset({region}, {.by = -rounded(widest / 2 * band)}).empty();
}

}  // namespace weft::infill
