// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/strips.h"

#include "geometry/offset.h"
#include "infill/scan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace weft::infill {

namespace {

double edge_um(const Region& region) {
  double um = perimeter_of(region.outer);
  for (const Ring& hole : region.holes) um += perimeter_of(hole);
  return um;
}

/// Whether an area is on the mean no wider than some lines.
bool is_narrow(const Region& region, Um band) {
  return 2e6 * area_mm2(region) <= widest_strip * band * edge_um(region);
}

/// The direction (against X) that an edge has on the mean, weighted by the square of its parts' lengths: ends that
/// slant do not turn it. And the share of its length that runs one way, less what runs across.
struct EdgeDirection {
  double angle_rad = 0, share = 0;
};
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

}  // namespace

std::optional<double> angle_of_axis(const Region& region, std::optional<double> bend) {
  constexpr double longer = 2;                            // than wide
  double area = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;  // moments of the triangles between edges and a corner
  const Point corner = box_of(region.outer).min;
  const auto add = [&](const Ring& ring) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const double ax = ring[j].x - corner.x, ay = ring[j].y - corner.y, bx = ring[i].x - corner.x,
                   by = ring[i].y - corner.y, twice = ax * by - bx * ay;
      area += twice / 2, x += twice * (ax + bx) / 6, y += twice * (ay + by) / 6;
      xx += twice * (ax * ax + ax * bx + bx * bx) / 12, yy += twice * (ay * ay + ay * by + by * by) / 12;
      xy += twice * (2 * ax * ay + ax * by + bx * ay + 2 * bx * by) / 24;
    }
  };
  add(region.outer);
  for (const Ring& hole : region.holes) add(hole);
  if (area <= 0) return std::nullopt;
  xx -= x * x / area, yy -= y * y / area, xy -= x * y / area;
  const double mean = (xx + yy) / 2, apart = std::hypot((xx - yy) / 2, xy);
  if (mean + apart < longer * longer * (mean - apart)) return std::nullopt;
  const double angle = std::atan2(2 * xy, xx - yy) / 2;
  if (!bend) return angle;
  const Outline along(region, Frame(angle, region.outer.front())),
      across(region, Frame(angle + std::numbers::pi / 2, region.outer.front()));
  const double width = area / (across.greatest_y() - across.least_y());
  return along.greatest_y() - along.least_y() <= width + *bend ? std::optional(angle) : std::nullopt;
}

std::optional<double> angle_along_walls(const Region& region) {
  constexpr double shortest_um = 1000;  // of what counts as a straight wall
  constexpr double least_share = 0.25;  // of the edge: less is chance
  constexpr std::size_t bins = 90;
  constexpr double quarter = std::numbers::pi / 2;
  constexpr double same = 0.1 * std::numbers::pi / 180;  // two microns over a millimetre
  struct Straight {
    double angle = 0, length = 0;
    std::size_t bin = 0;
  };
  std::vector<Straight> all;
  std::array<double, bins> length{};
  double whole = 0, straight = 0;
  const auto look = [&](const Ring& ring) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const double l = distance(ring[j], ring[i]);
      whole += l;
      if (l < shortest_um) continue;
      double a = std::fmod(std::atan2(ring[i].y - ring[j].y, ring[i].x - ring[j].x) + 2 * std::numbers::pi, quarter);
      if (a > quarter - 1e-9) a = 0;
      const auto bin = static_cast<std::size_t>(std::lround(a / quarter * bins)) % bins;
      length[bin] += l, straight += l;
      all.push_back({bin == 0 && a > quarter / 2 ? a - quarter : a, l, bin});
    }
  };
  look(region.outer);
  for (const Ring& hole : region.holes) look(hole);
  const auto peak = static_cast<std::size_t>(std::max_element(length.begin(), length.end()) - length.begin());
  if (length[peak] < straight / 2 || length[peak] < least_share * whole) return std::nullopt;
  std::erase_if(all, [&](const Straight& each) { return each.bin != peak; });
  std::stable_sort(all.begin(), all.end(), [](const Straight& a, const Straight& b) { return a.angle < b.angle; });
  double best = 0, longest = 0, sum = 0;
  std::optional<double> angle;
  for (std::size_t from = 0, to = 0; to < all.size(); ++to) {  // a window of directions that are one
    sum += all[to].length;
    for (; all[to].angle - all[from].angle > same; ++from) sum -= all[from].length;
    if (sum <= best) continue;
    best = sum, longest = 0;
    for (std::size_t i = from; i <= to; ++i)
      if (all[i].length > longest) longest = all[i].length, angle = all[i].angle;
  }
  return angle;
}

std::optional<double> angle_along_strip(const Region& region, Um band) {
  constexpr double straight = 0.8;  // of the edge
  if (!is_narrow(region, band)) return std::nullopt;
  const EdgeDirection edge = direction_of_edge(region);
  return edge.share < straight ? std::nullopt : std::optional(edge.angle_rad);
}

std::optional<double> angle_along_narrow(const Region& region, Um band) {
  return is_narrow(region, band) ? angle_of_axis(region, band) : std::nullopt;
}

std::optional<double> angle_of_long_lines(const Region& region, double angle_rad) {
  constexpr double clearly = 2;
  double along = 0, across = 0;  // of the edge: lines that run across end on what is along
  const double c = std::cos(angle_rad), s = std::sin(angle_rad);
  const auto look = [&](const Ring& ring) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const double dx = ring[i].x - ring[j].x, dy = ring[i].y - ring[j].y;
      along += std::abs(c * dx + s * dy), across += std::abs(c * dy - s * dx);
    }
  };
  look(region.outer);
  for (const Ring& hole : region.holes) look(hole);
  if (along >= clearly * across) return angle_rad;
  if (across >= clearly * along) return angle_rad + std::numbers::pi / 2;
  return std::nullopt;
}

bool is_strip(const Region& region, Um band) {
  constexpr double widest = 3.5;  // bands: of more rings the innermost are dabs where the strip bends
  // Times as long as wide in its widest place: rings in a triangle end in a dab, too, however long its edge is.
  constexpr double longer = 4;
  const double edge = edge_um(region), most = std::min(widest * band, edge / 2 / (longer + 1)) / 2;
  if (1e6 * area_mm2(region) > most * edge) return false;
  return geometry::offset({region}, {.by = -rounded(most)}).empty();
}

}  // namespace weft::infill
