// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/rungs_below.h"

#include "geometry/offset.h"
#include "support/lengths.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace weft::pipeline {
namespace {

geometry::Segment way_of(const Bead& rung) {
  return {rung.path[0].at, rung.path[1].at};
}

/// How far past the nearer end of a rung a place lies, along it.
double past_end(Point p, const geometry::Segment& way) {
  const double length = std::max(distance(way.a, way.b), 1.0);
  const double along = static_cast<double>(dot(p - way.a, way.b - way.a)) / length;
  return std::max(-along, along - length);
}

/// Where the middle of a rung may be. Areas of a column and of a roof beside it, which meet but for a hair, are one.
Regions middles_in(const Regions& area, Um line) {
  const Um hair = area.size() > 1 ? support::outline_bound : 0;
  return geometry::offset(support::grown(area, hair), {.by = -line * 4 / 10 - hair});
}

}  // namespace

RungsBelow::RungsBelow(const Beads& beads, const Regions& area, LayerPlastic below, const RungStyle& style)
    : laid_(segments_of(beads)), inside_(middles_in(area, style.line)), below_(std::move(below)), style_(style) {}

std::vector<Point> RungsBelow::brackets(std::span<const Point> hang, std::span<const Point> ends) {
  std::vector<Point> out;
  const auto bracket = [&](Point p, bool top) {
    const auto way = out_to(p);
    if (!way) return;
    brackets_.push_back({*way, top});
    if (!holds_itself(*way)) out.push_back(lerp(p, way->a, style_.step / distance(way->a, way->b)));
  };
  for (const Point p : ends) {
    if (is_near(p, style_.line / 2.0) || !inside_.region_at(p)) continue;
    if (const auto way = best_through(p))
      lay(*way);
    else
      bracket(p, false);
  }
  for (const Point p : furthest_first(hang))
    if (!is_near(p, held()) && !best_through(p)) bracket(p, true);
  return out;
}

Beads RungsBelow::rungs(std::span<const Point> hang, const Beads& under) && {
  const auto in_air = [&](const geometry::Segment& way) {
    return !holds_itself(way) && std::none_of(under.begin(), under.end(), [&](const Bead& rung) {
      return geometry::foot_of(way.b, way_of(rung)).distance_um < style_.step + style_.line / 4.0;
    });
  };
  std::erase_if(brackets_, [&](const Bracket& bracket) { return in_air(bracket.way); });
  for (const Bracket& bracket : brackets_) lay(bracket.way);
  bars();
  for (const Point p : hang) {
    if (is_near(p, held()) || !inside_.region_at(p)) continue;
    auto way = on_one_below(p, under);
    if (!way) way = best_through(p);
    if (way) lay(*way);
  }
  return std::move(out_);
}

/// Between ends of topmost brackets that have no third one between them: strands that run out along brackets lie on
/// these.
void RungsBelow::bars() {
  std::vector<Point> ends;
  for (const Bracket& bracket : brackets_)
    if (bracket.top) ends.push_back(bracket.way.b);
  const auto has_between = [&](Point a, Point b, double length) {
    return std::any_of(ends.begin(), ends.end(),
                       [&](Point c) { return c != a && c != b && std::max(distance(a, c), distance(b, c)) < length; });
  };
  for (std::size_t i = 0; i < ends.size(); ++i)
    for (std::size_t j = i + 1; j < ends.size(); ++j) {
      const geometry::Segment bar{ends[i], ends[j]};
      const double length = distance(bar.a, bar.b);
      if (length < 2 * style_.line || length > style_.span || has_between(bar.a, bar.b, length)) continue;
      if (inside_.crosses(bar.a, bar.b) || laid_.nearest(lerp(bar.a, bar.b, 0.5), style_.line)) continue;
      lay(bar);
    }
}

/// Whether a bracket does with nothing below but its root.
bool RungsBelow::holds_itself(const geometry::Segment& way) const {
  return distance(way.a, way.b) <= style_.stub || below_.lies(way.b);
}

void RungsBelow::lay(const geometry::Segment& way) {
  Bead& rung = out_.emplace_back();
  rung.role = Role::support, rung.sequence = 1;
  rung.path = {{way.a, style_.band, 1.F}, {way.b, style_.band, 1.F}};
}

bool RungsBelow::is_near(Point p, double by) const {
  const auto near = [&](const geometry::Segment& way) {
    const geometry::Foot foot = geometry::foot_of(p, way);
    return foot.distance_um < by && past_end(p, way) <= style_.line / 2.0 &&
           !laid_.crosses(p, lerp(way.a, way.b, foot.along));
  };
  return std::any_of(brackets_.begin(), brackets_.end(), [&](const Bracket& bracket) { return near(bracket.way); }) ||
         std::any_of(out_.begin(), out_.end(), [&](const Bead& rung) { return near(way_of(rung)); });
}

std::optional<geometry::Segment> RungsBelow::on_one_below(Point p, const Beads& under) {
  for (const Bead& rung : under) {
    const auto [a, b] = way_of(rung);
    if (geometry::foot_of(p, {a, b}).distance_um >= held()) continue;
    const auto way = across(lerp(a, b, 0.5), std::atan2(b.y - a.y, b.x - a.x));
    if (way && geometry::foot_of(p, *way).distance_um < held()) return way;
  }
  return std::nullopt;
}

/// Of all ways the one of which most ends lie on something, and the shortest of those.
std::optional<geometry::Segment> RungsBelow::best_through(Point p) {
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
std::optional<geometry::Segment> RungsBelow::across(Point p, double direction_rad) {
  const Point to{rounded(style_.span * std::cos(direction_rad)), rounded(style_.span * std::sin(direction_rad))};
  const auto a = next(p, -to), b = next(p, to);
  if (!a || !b) return std::nullopt;
  const double length = distance(*a, *b);
  if (length < style_.line || length > style_.span) return std::nullopt;
  return geometry::Segment{*a, *b};
}

std::optional<Point> RungsBelow::next(Point from, Point way) {
  found_.clear();
  laid_.crossings(from, from + way, found_);
  if (found_.empty()) return std::nullopt;
  const Point at = lerp(from, from + way, found_.front().along);
  return inside_.crosses(from, at) ? std::nullopt : std::optional(at);
}

/// Places from the one that is furthest from any bead on: what is nearer mostly lies on the brackets for those.
std::vector<Point> RungsBelow::furthest_first(std::span<const Point> places) const {
  std::vector<std::pair<double, Point>> by_distance;
  for (const Point p : places)
    if (const auto end = into(p))
      if (const auto root = laid_.nearest(*end, style_.out)) by_distance.push_back({distance(*end, root->at), *end});
  std::stable_sort(by_distance.begin(), by_distance.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<Point> out;
  for (const auto& [um, p] : by_distance) out.push_back(p);
  return out;
}

/// A place in the area, no further away than below the bead there: where columns lean a roof is wider than they are.
std::optional<Point> RungsBelow::into(Point p) const {
  if (inside_.region_at(p)) return p;
  const auto edge = inside_.nearest(p, style_.line / 2.0);
  return edge ? std::optional(edge->at) : std::nullopt;
}

/// From the nearest bead to p, no further than a column's line is from its edge.
std::optional<geometry::Segment> RungsBelow::out_to(Point p) const {
  const auto root = laid_.nearest(p, style_.out);
  if (!root || inside_.crosses(root->at, p)) return std::nullopt;
  return geometry::Segment{root->at, p};
}

}  // namespace weft::pipeline
