// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/shared_misfit.h"

#include <algorithm>
#include <cmath>

namespace weft::infill {
namespace {

double height_at(const std::vector<Knot>& profile, double x) {
  if (x <= profile.front().x || x >= profile.back().x) return 0;
  const auto after = std::find_if(profile.begin(), profile.end(), [x](const Knot& each) { return each.x >= x; });
  const Knot &a = after[-1], &b = *after;
  return b.x > a.x ? std::lerp(a.more, b.more, (x - a.x) / (b.x - a.x)) : b.more;
}

}  // namespace

SharedMisfit::SharedMisfit(std::span<const Interval> intervals, std::span<const Edge> below,
                           std::span<const Edge> above, double ramp, int lines)
    : intervals_(intervals), ramp_(ramp), lines_(lines) {
  share(below, false);
  share(above, true);
  for (auto& side : of_)
    std::stable_sort(side.begin(), side.end(), [](const Moved& a, const Moved& b) { return a.interval < b.interval; });
}

std::pair<std::uint32_t, std::uint32_t> SharedMisfit::on_line(int line) const {
  const auto before = [](const Interval& each, int l) { return each.line < l; };
  const auto first = std::lower_bound(intervals_.begin(), intervals_.end(), line, before),
             last = std::lower_bound(first, intervals_.end(), line + 1, before);
  return {static_cast<std::uint32_t>(first - intervals_.begin()),
          static_cast<std::uint32_t>(last - intervals_.begin())};
}

/// The interval, and those away from the edge that lie beside it for as long as it takes to come back.
std::vector<std::uint32_t> SharedMisfit::sharers(std::uint32_t interval, double from, double to, bool above) const {
  std::vector<std::uint32_t> out{interval};
  for (int away = 1; away < lines_; ++away) {
    const auto [first, last] = on_line(intervals_[interval].line + (above ? -away : away));
    double most = 2 * ramp_;
    std::uint32_t best = last;
    for (std::uint32_t i = first; i < last; ++i) {
      const double common = std::min(intervals_[i].to, to) - std::max(intervals_[i].from, from);
      if (common > most) most = common, best = i;
    }
    if (best == last) break;
    out.push_back(best);
    from = std::max(from, intervals_[best].from), to = std::min(to, intervals_[best].to);
  }
  return out;
}

void SharedMisfit::share(std::span<const Edge> edges, bool above) {
  for (std::size_t first = 0, end = 0; first < edges.size(); first = end) {
    const std::uint32_t interval = edges[first].interval;
    Profile profile{{edges[first].from.x - ramp_, 0}};
    for (; end < edges.size() && edges[end].interval == interval &&
           (end == first || edges[end].from.x < edges[end - 1].to.x + 2 * ramp_);
         ++end)
      profile.insert(profile.end(), {edges[end].from, edges[end].to});
    const double to = edges[end - 1].to.x;
    profile.push_back({to + ramp_, 0});
    const std::vector<std::uint32_t> all = sharers(interval, edges[first].from.x, to, above);
    if (all.size() < 2) continue;
    const auto which = static_cast<std::uint32_t>(profiles_.size());
    profiles_.push_back(std::move(profile));
    for (std::size_t i = 0; i < all.size(); ++i) {
      const auto n = static_cast<double>(all.size()), left = n - static_cast<double>(i);  // that share what is left
      of_[above].push_back({all[i], which, left / n});
      of_[!above].push_back({all[i], which, -(left - 1) / n});
    }
  }
}

std::span<const SharedMisfit::Moved> SharedMisfit::of(std::uint32_t interval, bool above) const {
  const std::vector<Moved>& side = of_[above];
  const auto first = std::lower_bound(side.begin(), side.end(), interval,
                                      [](const Moved& each, std::uint32_t i) { return each.interval < i; });
  auto last = first;
  while (last != side.end() && last->interval == interval) ++last;
  return std::span(first, last);
}

double SharedMisfit::at(std::uint32_t interval, bool above, double x) const {
  double more = 0;
  for (const Moved& each : of(interval, above)) more += each.share * height_at(profiles_[each.profile], x);
  return more;
}

std::vector<Knot> SharedMisfit::along(std::uint32_t interval, bool above, double from, double to) const {
  const std::span<const Moved> moved = of(interval, above);
  std::vector<Knot> out{{from, 0}, {to, 0}};
  if (moved.empty()) return out;
  for (const Moved& each : moved)
    for (const Knot& knot : profiles_[each.profile])
      if (knot.x > from && knot.x < to) out.push_back({knot.x, 0});
  std::sort(out.begin(), out.end(), [](const Knot& a, const Knot& b) { return a.x < b.x; });
  for (Knot& knot : out) knot.more = at(interval, above, knot.x);
  return out;
}

}  // namespace weft::infill
