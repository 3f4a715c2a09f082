// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/rungs_below.h"

#include "geometry/offset.h"
#include "geometry/spatial_index.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace weft::pipeline {
namespace {

class Rungs {
 public:
  Rungs(const Beads& beads, const Regions& area, const Beneath& below, const Beads& under, const RungStyle& style)
      : laid_(segments_of(beads)),
        inside_(geometry::offset(area, {.by = -style.line * 4 / 10})),
        below_(below),
        under_(under),
        style_(style) {}

  /// Below p, but where one is near, or none is short enough not to sag.
  void below(Point p) {
    if (is_near(p) || !inside_.region_at(p)) return;
    auto way = on_one_below(p);
    if (!way) way = best_through(p);
    if (!way) return;
    Bead& rung = out_.emplace_back();
    rung.role = Role::support, rung.sequence = 1;
    rung.path = {{way->a, style_.band, 1.F}, {way->b, style_.band, 1.F}};
  }
  Beads laid() && { return std::move(out_); }

 private:
  bool is_near(Point p) const {
    return std::any_of(out_.begin(), out_.end(), [&](const Bead& rung) { return holds(way_of(rung), p); });
  }
  bool holds(const geometry::Segment& way, Point p) const {
    return geometry::foot_of(p, way).distance_um < style_.span * 0.6;
  }
  static geometry::Segment way_of(const Bead& rung) { return {rung.path[0].at, rung.path[1].at}; }
  std::optional<geometry::Segment> on_one_below(Point p) {
    for (const Bead& rung : under_) {
      const auto [a, b] = way_of(rung);
      if (!holds({a, b}, p)) continue;
      const auto way = across(lerp(a, b, 0.5), std::atan2(b.y - a.y, b.x - a.x));
      if (way && holds(*way, p)) return way;
    }
    return std::nullopt;
  }
  /// Of all ways the one of which most ends lie on something, and the shortest of those.
  std::optional<geometry::Segment> best_through(Point p) {
    constexpr int ways = 8;
    std::optional<geometry::Segment> best;
    double least = 0;
    for (int i = 0; i < ways; ++i) {
      const auto way = across(p, std::numbers::pi * i / ways);
      if (!way) continue;
      const int hanging = (below_.lies(way->a) ? 0 : 1) + (below_.lies(way->b) ? 0 : 1);
      const double cost = distance(way->a, way->b) + hanging * style_.span;
      if (best && cost >= least) continue;
      best = way, least = cost;
    }
    return best;
  }
  /// From bead to bead through p.
  std::optional<geometry::Segment> across(Point p, double direction_rad) {
    const Point to{rounded(style_.span * std::cos(direction_rad)), rounded(style_.span * std::sin(direction_rad))};
    const auto a = next(p, -to), b = next(p, to);
    if (!a || !b) return std::nullopt;
    const double length = distance(*a, *b);
    if (length < style_.line || length > style_.span) return std::nullopt;
    return geometry::Segment{*a, *b};
  }
  std::optional<Point> next(Point from, Point way) {
    found_.clear();
    laid_.crossings(from, from + way, found_);
    if (found_.empty()) return std::nullopt;
    const Point at = lerp(from, from + way, found_.front().along);
    return inside_.crosses(from, at) ? std::nullopt : std::optional(at);
  }

  geometry::SegmentIndex laid_, inside_;
  const Beneath& below_;
  const Beads& under_;
  const RungStyle& style_;
  std::vector<geometry::SegmentIndex::Crossing> found_;
  Beads out_;
};

}  // namespace

Beads rungs_below(std::span<const Point> hang, const Beads& beads, const Regions& area, const Beneath& below,
                  const Beads& under, const RungStyle& style) {
  Rungs rungs(beads, area, below, under, style);
  for (const Point p : hang) rungs.below(p);
  return std::move(rungs).laid();
}

}  // namespace weft::pipeline
