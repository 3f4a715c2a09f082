// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/fan_lead.h"

#include <algorithm>
#include <cstddef>
#include <optional>

namespace weft::motion {
namespace {

/// From then on the fan turns at that share.
struct Change {
  double time_s, share;
};

/// What the steps say, and they without it.
std::vector<Change> taken(TimedSteps& from, TimedSteps& rest) {
  std::vector<Change> out;
  double time = 0;
  for (std::size_t i = 0; i < from.steps.size(); ++i) {
    if (const auto* fan = std::get_if<SetFan>(&from.steps[i])) {
      if (!out.empty() && out.back().time_s == time) out.pop_back();
      out.push_back({time, fan->share});
    } else {
      rest.add(std::move(from.steps[i]), from.seconds[i]);
    }
    time += static_cast<double>(from.seconds[i]);
  }
  return out;
}

/// At each moment the most that is wanted from then on for that long.
std::vector<Change> led(const std::vector<Change>& changes, double lead_s) {
  std::vector<double> times;
  for (const Change& change : changes) {
    times.push_back(change.time_s);
    times.push_back(std::max(change.time_s - lead_s, 0.0));
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  std::vector<Change> out;
  std::size_t in_force = 0;
  for (const double time : times) {
    while (in_force + 1 < changes.size() && changes[in_force + 1].time_s <= time) ++in_force;
    double share = changes[in_force].time_s <= time ? changes[in_force].share : 0;
    for (std::size_t i = in_force + 1; i < changes.size() && changes[i].time_s <= time + lead_s; ++i)
      share = std::max(share, changes[i].share);
    if (out.empty() || out.back().share != share) out.push_back({time, share});
  }
  return out;
}

/// The junction of a bead that it is at after a share of its time, at the latest; a long straight piece gets one more.
/// 0: it has just begun.
std::size_t junction_after(Extrude& bead, double share) {
  constexpr double long_um = 2000;
  std::vector<double> seconds(bead.path.size());
  for (std::size_t i = 1; i < bead.path.size(); ++i) {
    const double speed =
        bead.segment_speed_mm_s.empty() ? bead.speed_mm_s : static_cast<double>(bead.segment_speed_mm_s[i - 1]);
    seconds[i] = seconds[i - 1] + distance(bead.path[i - 1].at, bead.path[i].at) / std::max(speed, 1e-3);
  }
  const double wanted = share * seconds.back();
  std::size_t at = 0;
  while (at + 1 < seconds.size() && seconds[at + 1] <= wanted) ++at;
  const auto arc =
      std::find_if(bead.arcs.begin(), bead.arcs.end(), [&](const Arc& a) { return a.first <= at && at < a.last; });
  if (arc != bead.arcs.end()) return arc->first;
  if (at + 1 >= bead.path.size()) return 0;
  const Junction a = bead.path[at], b = bead.path[at + 1];
  if (distance(a.at, b.at) < long_um) return at;
  const double t = (wanted - seconds[at]) / (seconds[at + 1] - seconds[at]);
  const auto next = static_cast<std::ptrdiff_t>(at) + 1;
  bead.path.insert(bead.path.begin() + next, {lerp(a.at, b.at, t), rounded(a.width + t * (b.width - a.width)),
                                              static_cast<float>(a.flow + t * static_cast<double>(b.flow - a.flow))});
  if (!bead.segment_speed_mm_s.empty())
    bead.segment_speed_mm_s.insert(bead.segment_speed_mm_s.begin() + next, bead.segment_speed_mm_s[at]);
  if (!bead.below.empty())
    bead.below.insert(bead.below.begin() + next,
                      rounded(bead.below[at] + t * (static_cast<double>(bead.below[at + 1]) - bead.below[at])));
  for (Arc& each : bead.arcs)
    if (each.first > at) ++each.first, ++each.last;
  return at + 1;
}

}  // namespace

void lead_fan(double lead_s, TimedSteps& steps) {
  TimedSteps rest;
  const auto changes = led(taken(steps, rest), lead_s);
  TimedSteps out;
  std::size_t next = 0;  // change
  double time = 0;
  const auto tell = [&] { out.add(SetFan{changes[next++].share}); };
  for (std::size_t i = 0; i < rest.steps.size(); ++i) {
    Step step = std::move(rest.steps[i]);
    double seconds = static_cast<double>(rest.seconds[i]);
    while (next < changes.size() && changes[next].time_s <= time) tell();
    while (next < changes.size() && changes[next].time_s < time + seconds) {
      auto* bead = std::get_if<Extrude>(&step);
      const double share = (changes[next].time_s - time) / seconds;
      const std::size_t at = bead != nullptr ? junction_after(*bead, share) : 0;
      if (at > 0 && at + 1 < bead->path.size()) {
        auto [before, after] = split(std::move(*bead), at);
        out.add(std::move(before), static_cast<float>(share * seconds));
        time += share * seconds, seconds -= share * seconds;
        step = std::move(after);
      }
      tell();
    }
    time += seconds;
    out.add(std::move(step), static_cast<float>(seconds));
  }
  while (next < changes.size()) tell();
  steps = std::move(out);
}

}  // namespace weft::motion
