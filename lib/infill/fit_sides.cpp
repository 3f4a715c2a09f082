// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/fit_sides.h"

#include "core/stop.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace weft::infill {
namespace {

constexpr double most_slope = 0.4;  // of an edge that lines run along: 22°, where a turn along it becomes too long
constexpr double shortest = 1;      // bands; a strand is not changed for a shorter edge
constexpr double jog = 1;           // bands along a line, in which it moves aside
constexpr double nearly_straight = 0.25;  // bands, that an edge lines share may lean or bend
constexpr double ramp = 2;                // bands along a line, in which those that share come back
constexpr double least_change_um = 15;    // of a side; for less no junction is worth it
constexpr double touching_um = 1;         // the lattice

/// Without the corners between which the sides stay where they are without them.
std::vector<Sides> thinned(const std::vector<Sides>& all) {
  const auto off = [&](std::size_t a, std::size_t b, std::size_t i) {
    const double t = all[b].x > all[a].x ? (all[i].x - all[a].x) / (all[b].x - all[a].x) : 1;
    return std::max(std::abs(std::lerp(all[a].below, all[b].below, t) - all[i].below),
                    std::abs(std::lerp(all[a].above, all[b].above, t) - all[i].above));
  };
  std::vector<Sides> kept{all.front()};
  for (std::size_t last = 0, next = 1; next < all.size(); ++next) {
    bool needed = next + 1 == all.size();
    for (std::size_t i = last + 1; i <= next && !needed; ++i) needed = off(last, next + 1, i) > least_change_um;
    if (needed) kept.push_back(all[next]), last = next;
  }
  return kept;
}

}  // namespace

double SideFit::reach_at(const Corner& a, const Corner& b, double x) {
  return b.x > a.x ? a.reach + (b.reach - a.reach) * (x - a.x) / (b.x - a.x) : b.reach;
}

bool SideFit::along(Turned a, Turned b) {
  return std::abs(b.y - a.y) <= most_slope * std::abs(b.x - a.x);
}

SideFit::SideFit(const Outline& outline, const LineSet& lines, std::span<const Interval> intervals, double band,
                 const FitWidths& widths)
    : band_(band), widths_(widths), intervals_(intervals), beside_(intervals.size(), false) {
  std::vector<std::uint32_t> first(static_cast<std::size_t>(lines.count) + 1, 0);
  for (const Interval& i : intervals) ++first[static_cast<std::size_t>(i.line) + 1];
  for (std::size_t k = 1; k < first.size(); ++k) first[k] += first[k - 1];

  const auto n = static_cast<std::uint32_t>(outline.points().size());
  StopNowAndThen stop(64);
  for (std::uint32_t e = 0; e < n; ++e) {
    stop.step();
    Turned a = outline.points()[e], b = outline.points()[outline.next(e)];
    if (!along(a, b) || a.x == b.x || outline.is_loose(e)) continue;
    const bool ceiling = b.x < a.x;  // the inside is to the left
    if (ceiling) std::swap(a, b);
    const double slope = (b.y - a.y) / (b.x - a.x);
    const double low = std::min(a.y, b.y) - (ceiling ? band : 0), high = std::max(a.y, b.y) + (ceiling ? 0 : band);
    const int from_line = static_cast<int>(std::max(0.0, std::floor((low - lines.first) / lines.spacing)));
    const int to_line = static_cast<int>(std::min(lines.count - 1.0, std::ceil((high - lines.first) / lines.spacing)));
    for (int k = from_line; k <= to_line; ++k) {
      const auto gap = [&](double x) {
        const double y = a.y + slope * (x - a.x) - lines.y(k);
        return ceiling ? y : -y;
      };
      // where 0 ≤ gap ≤ band
      double from = a.x, to = b.x;
      const double gap_slope = ceiling ? slope : -slope;
      if (std::abs(gap_slope) > 1e-12) {
        double x0 = a.x + (0 - gap(a.x)) / gap_slope, x1 = a.x + (band - gap(a.x)) / gap_slope;
        if (x0 > x1) std::swap(x0, x1);
        from = std::max(from, x0), to = std::min(to, x1);
      } else if (gap(a.x) < 0 || gap(a.x) > band) {
        continue;
      }
      const auto k0 = static_cast<std::size_t>(k);
      const auto begin = intervals.begin() + first[k0], end = intervals.begin() + first[k0 + 1];
      auto i = std::lower_bound(begin, end, from, [](const Interval& each, double x) { return each.to <= x; });
      for (; i != end && i->from < to; ++i) {
        const double l = std::max(from, i->from), r = std::min(to, i->to);
        if (l >= r) continue;
        const auto at = static_cast<std::uint32_t>(i - intervals.begin());
        beside_[at] = true;
        (ceiling ? above_ : below_).push_back({at, l, r, std::clamp(gap(l), 0.0, band), std::clamp(gap(r), 0.0, band)});
      }
    }
  }
  const auto before = [](const Beside& p, const Beside& q) {
    return p.interval != q.interval ? p.interval < q.interval
           : p.from != q.from       ? p.from < q.from
                                    : p.at_from < q.at_from;
  };
  std::sort(above_.begin(), above_.end(), before);
  std::sort(below_.begin(), below_.end(), before);
  if (widths_.shared_by < 2) return;
  shared_ = {intervals_, straight(below_), straight(above_), ramp * band_, widths_.shared_by};
  for (std::uint32_t i = 0; i < beside_.size(); ++i) beside_[i] = beside_[i] || shared_.concerns(i);
}

/// The straight edge that fits some best that follow each other: least squares over their length.
/// Pre: of one interval, from left to right, and not all at one place
SharedMisfit::Edge SideFit::fitted(std::span<const Beside> run) const {
  double w = 0, x = 0, y = 0, xx = 0, xy = 0;
  const double x0 = run.front().from;
  for (const Beside& each : run) {
    const double l = each.to - each.from, a = each.from - x0, b = each.to - x0, p = each.at_from, q = each.at_to;
    w += l, x += l * (a + b) / 2, y += l * (p + q) / 2;
    xx += l * (a * a + a * b + b * b) / 3, xy += l * (2 * a * p + a * q + b * p + 2 * b * q) / 6;
  }
  x /= w, y /= w, xx /= w, xy /= w;
  const double slope = (xy - x * y) / (xx - x * x);
  const auto knot = [&](double at) { return Knot{at, y + slope * (at - x0 - x) - band_ / 2}; };
  return {run.front().interval, knot(x0), knot(run.back().to)};
}

/// Edges along which lines run for long, nearly straight. Pre: by interval and then from left to right
std::vector<SharedMisfit::Edge> SideFit::straight(const Besides& all) const {
  std::vector<SharedMisfit::Edge> out;
  for (std::size_t first = 0, end = 0; first < all.size(); first = std::max(end, first + 1)) {
    double least = all[first].at_from, most = least;
    for (end = first; end < all.size() && all[end].interval == all[first].interval &&
                      (end == first || std::abs(all[end].from - all[end - 1].to) <= touching_um);
         ++end) {
      least = std::min({least, all[end].at_from, all[end].at_to}),
      most = std::max({most, all[end].at_from, all[end].at_to});
      if (most - least > nearly_straight * band_) break;
    }
    if (end == first || all[end - 1].to - all[first].from < 2 * ramp * band_) continue;
    const bool hidden =
        !out.empty() && out.back().interval == all[first].interval && all[first].from < out.back().to.x - touching_um;
    if (!hidden)
      out.push_back(
          fitted({all.begin() + static_cast<std::ptrdiff_t>(first), all.begin() + static_cast<std::ptrdiff_t>(end)}));
  }
  return out;
}

std::vector<SideFit::Corner> SideFit::side(bool is_above, std::uint32_t interval) const {
  const Besides& all = is_above ? above_ : below_;
  const double half = band_ / 2;
  const double from = intervals_[interval].from, to = intervals_[interval].to;
  auto it = std::lower_bound(all.begin(), all.end(), interval,
                             [](const Beside& each, std::uint32_t i) { return each.interval < i; });
  std::vector<Corner> corners, stretch;
  double open = from;  // where the last stretch ended
  const auto leave_plain = [&](double until) {
    if (until - open <= jog * band_) return;
    for (const Knot& knot : shared_.along(interval, is_above, open, until))
      corners.push_back({knot.x, half + knot.more});
  };
  while (it != all.end() && it->interval == interval) {
    // edges that follow each other without a hole between them are one stretch
    stretch.clear();
    for (double reached = it->from; it != all.end() && it->interval == interval && it->from <= reached + touching_um;
         ++it) {
      if (it->to <= reached) continue;  // hidden behind the last one
      const Corner a{it->from, it->at_from}, b{it->to, it->at_to};
      const double x = std::max(reached, a.x);
      stretch.insert(stretch.end(), {{x, reach_at(a, b, x)}, b});
      reached = b.x;
    }
    if (stretch.back().x - stretch.front().x < shortest * band_) continue;
    leave_plain(stretch.front().x);
    corners.insert(corners.end(), stretch.begin(), stretch.end());
    open = stretch.back().x;
  }
  leave_plain(to);
  if (corners.empty())
    for (const Knot& knot : shared_.along(interval, is_above, from, to)) corners.push_back({knot.x, half + knot.more});
  // what jumps takes a way along the line
  for (std::size_t i = 1; i < corners.size(); ++i) {
    Corner &a = corners[i - 1], &b = corners[i];
    if (b.x - a.x > touching_um || std::abs(b.reach - a.reach) < least_change_um) continue;
    const double before = i > 1 ? a.x - corners[i - 2].x : 0,
                 after = i + 1 < corners.size() ? corners[i + 1].x - b.x : 0;
    a.x -= std::min(jog * band_, before) / 2, b.x += std::min(jog * band_, after) / 2;
  }
  return corners;
}

std::vector<Sides> SideFit::both(std::uint32_t interval) const {
  const std::vector<Corner> below = side(false, interval), above = side(true, interval);
  const auto between = [](const std::vector<Corner>& c, std::size_t i, double x) {
    return i == 0 ? c.front().reach : i < c.size() ? reach_at(c[i - 1], c[i], x) : c.back().reach;
  };
  std::vector<Sides> all;
  for (std::size_t b = 0, a = 0; b < below.size() || a < above.size();) {
    if (a == above.size() || (b < below.size() && below[b].x <= above[a].x)) {
      all.push_back({below[b].x, below[b].reach, between(above, a, below[b].x)}), ++b;
    } else {
      all.push_back({above[a].x, between(below, b, above[a].x), above[a].reach}), ++a;
    }
  }
  return all;
}

std::optional<std::pair<double, double>> SideFit::with_room(std::uint32_t interval) const {
  const std::vector<Sides> all = both(interval);
  const double least = widths_.least / 2 * band_;
  const auto has_room = [&](const Sides& each) { return each.below + each.above >= least; };
  const auto first = std::find_if(all.begin(), all.end(), has_room);
  if (first == all.end()) return std::nullopt;
  const auto last = std::find_if(all.rbegin(), all.rend(), has_room).base() - 1;
  const auto between = [&](const Sides& narrow, const Sides& wide) {
    const double w = narrow.below + narrow.above, t = (least - w) / (wide.below + wide.above - w);
    return std::lerp(narrow.x, wide.x, t);
  };
  return std::pair{first == all.begin() ? first->x : between(first[-1], *first),
                   last + 1 == all.end() ? last->x : between(last[1], *last)};
}

/// Stretches that are narrower, or wider, than the line is without its own edges are looked at one by one.
void SideFit::keep_within_widths(std::uint32_t interval, std::vector<Sides>& all) const {
  const bool shares = shared_.concerns(interval);
  const auto plain = [&](double x) {
    return shares ? band_ + shared_.at(interval, false, x) + shared_.at(interval, true, x) : band_;
  };
  const auto change = [&](const Sides& each) {
    const double more = each.below + each.above - plain(each.x);
    return more < -least_change_um ? -1 : more > least_change_um ? 1 : 0;
  };
  for (std::size_t first = 0, end = 0; first < all.size(); first = end) {
    const int side = change(all[first]);
    while (end < all.size() && change(all[end]) == side) ++end;
    const double from = first > 0 ? std::midpoint(all[first - 1].x, all[first].x) : all[first].x,
                 to = end < all.size() ? std::midpoint(all[end - 1].x, all[end].x) : all[end - 1].x;
    const bool followed = side != 0 && to - from >= widths_.steady_from * band_;
    for (std::size_t i = first; i < end; ++i) {
      Sides& each = all[i];
      const double width = each.below + each.above,
                   more = (followed ? std::clamp(width, widths_.least * band_, widths_.most * band_) : plain(each.x)) -
                          width;
      each.below += more / 2, each.above += more / 2;
    }
  }
}

std::vector<Sides> SideFit::of(std::uint32_t interval) const {
  std::vector<Sides> all = both(interval);
  keep_within_widths(interval, all);
  return thinned(all);
}

}  // namespace weft::infill
