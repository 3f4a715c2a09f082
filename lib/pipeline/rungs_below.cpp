// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/rungs_below.h"

#include "geometry/offset.h"
#include "geometry/spatial_index.h"
#include "pipeline/beneath.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace weft::pipeline {

Beads rungs_below(std::span<const Point> hang, const Beads& beads, const Regions& area, const RungStyle& style) {
  const geometry::SegmentIndex laid = segments_of(beads), inside(geometry::offset(area, {.by = -style.line * 4 / 10}));
  const Point to{rounded(style.span * std::cos(style.direction_rad)),
                 rounded(style.span * std::sin(style.direction_rad))};
  std::vector<geometry::SegmentIndex::Crossing> found;
  const auto next = [&](Point from, Point way) -> std::optional<Point> {
    found.clear();
    laid.crossings(from, from + way, found);
    if (found.empty()) return std::nullopt;
    const Point at = lerp(from, from + way, found.front().along);
    return inside.crosses(from, at) ? std::nullopt : std::optional(at);
  };
  Beads out;
  const auto is_near = [&](Point p) {
    return std::any_of(out.begin(), out.end(), [&](const Bead& rung) {
      return geometry::foot_of(p, {rung.path[0].at, rung.path[1].at}).distance_um < style.span * 0.6;
    });
  };
  for (const Point p : hang) {
    if (is_near(p) || !inside.region_at(p)) continue;
    const auto a = next(p, -to), b = next(p, to);
    if (!a || !b) continue;
    const double length = distance(*a, *b);
    if (length < style.line || length > style.span) continue;  // longer ones would sag themselves
    Bead& rung = out.emplace_back();
    rung.role = Role::support;
    rung.path = {{*a, style.band, 1.F}, {*b, style.band, 1.F}};
  }
  return out;
}

}  // namespace weft::pipeline
