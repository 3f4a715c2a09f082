// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/fitted_lines.h"

#include "infill/fit_sides.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace weft::infill {
namespace {

/// Where edges run along lines, at one height as nearly as matters.
struct Level {
  double length = 0, y = 0;
};

/// The level of most edges. Notches part a side into pieces, and it is one nevertheless.
Level longest_level(std::vector<Level>& edges, double near) {
  std::sort(edges.begin(), edges.end(), [](const Level& a, const Level& b) { return a.y < b.y; });
  Level best, sum;  // of a window that moves upwards; its y is a moment
  for (std::size_t from = 0, to = 0; to < edges.size(); ++to) {
    sum.length += edges[to].length, sum.y += edges[to].length * edges[to].y;
    for (; edges[to].y - edges[from].y > near; ++from)
      sum.length -= edges[from].length, sum.y -= edges[from].length * edges[from].y;
    if (sum.length > best.length) best = {sum.length, sum.y / sum.length};
  }
  return best;
}

}  // namespace

LineSet fitted_lines(const Outline& outline, double band) {
  constexpr double most_of = 0.5;  // of the outline's length along the lines
  constexpr double near = 0.1;     // bands: a tenth of a line more or less is one level
  const std::vector<Turned>& points = outline.points();
  std::vector<Level> floors, ceilings;
  double left = points.front().x, right = left;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Turned a = points[i], b = points[outline.next(i)];
    left = std::min(left, a.x), right = std::max(right, a.x);
    std::vector<Level>& side = b.x > a.x ? floors : ceilings;  // the inside is to the left
    if (SideFit::along(a, b) && !outline.is_loose(i)) side.push_back({std::abs(b.x - a.x), (a.y + b.y) / 2});
  }
  const Level floor = longest_level(floors, near * band), ceiling = longest_level(ceilings, near * band);
  double low = outline.least_y(), high = outline.greatest_y();
  const double long_enough = most_of * (right - left);
  if (std::min(floor.length, ceiling.length) >= long_enough && ceiling.y - floor.y > band / 2)
    low = floor.y, high = ceiling.y;
  else if (outline.has_loose_edges() && floor.length >= long_enough)
    low = floor.y, high = low + band;
  else if (outline.has_loose_edges() && ceiling.length >= long_enough)
    high = ceiling.y, low = high - band;
  const double count = std::max(1.0, std::round((high - low) / band)), spacing = (high - low) / count,
               below = std::round((low - outline.least_y()) / spacing),
               above = std::round((outline.greatest_y() - high) / spacing);
  return {low + (0.5 - below) * spacing, spacing, static_cast<int>(below + count + above)};
}

}  // namespace weft::infill
