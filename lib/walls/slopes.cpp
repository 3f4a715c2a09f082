// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/slopes.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/clip_lines.h"
#include "geometry/offset.h"

#include <cmath>

namespace weft::walls {
namespace {

std::vector<Polyline> closed_lines(const Regions& regions) {
  std::vector<Polyline> out;
  const auto add = [&](const Ring& ring) {
    if (ring.empty()) return;
    out.emplace_back(ring.begin(), ring.end());
    out.back().push_back(ring.front());
  };
  for (const Region& region : regions) {
    add(region.outer);
    for (const Ring& hole : region.holes) add(hole);
  }
  return out;
}

double length_within(const std::vector<Polyline>& lines, const Regions& area) {
  double length = 0;
  if (!area.empty())
    for (const auto& piece : geometry::clip_lines(lines, area)) length += length_of(piece.line);
  return length;
}

}  // namespace

std::vector<int> extra_walls(const Widths& widths, const Regions& regions, const Regions& above) {
  constexpr int most = 100;
  constexpr double worth_a_wall = 1.0 / 3, deep = 1.5;
  std::vector<int> out(regions.size(), 0);
  const auto lines = closed_lines(above);
  const auto inset = [](const Region& region, double by) {
    return geometry::offset({region}, {.by = -static_cast<Um>(std::lround(by))});
  };
  for (std::size_t i = 0; i < regions.size() && !lines.empty(); ++i) {
    stop_if_asked();
    const double whole = length_within(lines, {regions[i]});
    if (whole == 0) continue;
    // An outline this far in has the middle of its outer wall where the walls here end.
    double from = widths.bulge + widths.outer / 2 + (widths.walls - 1) * widths.inner;
    for (; out[i] < most; ++out[i], from += widths.inner) {
      const Regions beyond = inset(regions[i], from);
      if (beyond.empty()) break;
      const Regions over_nothing = geometry::subtract(beyond, inset(regions[i], from + deep * widths.inner));
      if (length_within(lines, over_nothing) <= worth_a_wall * whole) break;
    }
  }
  return out;
}

}  // namespace weft::walls
