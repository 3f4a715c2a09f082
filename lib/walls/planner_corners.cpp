// SPDX-License-Identifier: GPL-3.0-or-later
// How beads turn back in corners.
#include "core/stop.h"
#include "walls/planner.h"

#include <algorithm>
#include <cmath>

namespace weft::walls {

void Planner::find_throats() {
  for (const auto& run : runs_) {
    std::uint32_t below = none;
    int ways = 0;
    for_each_leaving(run.front(), [&](std::uint32_t h) {
      if (edges_[h / 2].core) below = h, ++ways;
    });
    if (ways != 1 || !edges_[run.front() / 2].mouth) continue;
    const Span& span = edges_[below / 2].span;
    if (span.middle || span.open) continue;
    for (const std::uint32_t h : run) edges_[h / 2].throat = static_cast<std::uint32_t>(throats_.size());
    throats_.push_back({span.pairs, below % 2 == 0 ? span.at_start : span.at_end});
  }
}

std::uint32_t Planner::bounds_beside(const Throat& throat, const Span& span, const Turn& turn, double slope,
                                     double clearance) {
  const double r = turn.reach, t = turn.past;
  const auto last = static_cast<std::size_t>(throat.pairs);
  const double above = out_.bounds[span.at_start + last], below = out_.bounds[throat.bounds + last];
  // How far the tip, a disc, reaches along the rib, which leans away from it by the slope.
  const double tip = t < r ? std::sqrt(r * r - t * t * (1 - slope * slope)) - t * slope : 0;
  // A wall is laid down by discs, too. One that fills the rib up to the tip lies under the tip beside the rib; discs
  // that only touch it, this far from the axis, leave a triangle bare. Half-way between them least is bare or covered
  // twice.
  const double room = clearance - out_.bounds[span.at_start + last - 1];
  const double touching = ((room + r) * (room + r) - t * t) / (2 * (t * slope + room + r));
  const double touched = std::min(clearance, clearance + room - 2 * touching);
  const double beside = (clearance - tip + touched) / 2;
  // Behind the tip that is wider in no time: an outer wall would step aside where it is straight to the eye.
  const double wanted = below > above ? std::min(beside, above + (below - above) * std::min(1.0, t / o_.ramp)) : beside;
  if (wanted <= above && clearance >= above) return span.at_start;
  const double share = below > above + same_um ? std::clamp((wanted - above) / (below - above), 0.0, 1.0) : 0;
  const auto at = static_cast<std::uint32_t>(out_.bounds.size());
  for (std::size_t i = 0; i < last; ++i) {
    const double b = out_.bounds[span.at_start + i];
    out_.bounds.push_back(std::min(clearance, b + share * std::max(0.0, out_.bounds[throat.bounds + i] - b)));
  }
  out_.bounds.push_back(std::max(wanted, std::min(above, clearance)));
  return at;
}

void Planner::fill_beside(std::uint32_t h, const Turn& turn) {
  const Throat* throat = throat_at(h / 2);
  const Span span = edges_[h / 2].span;
  if (throat == nullptr || turn.reach <= 0 || span.pairs != throat->pairs || span.pairs == 0) return;
  const double m = std::min(1.0, slope(h / 2));
  const Turn later{turn.reach, turn.past + s_.length(h / 2)};
  const std::uint32_t from = bounds_beside(*throat, span, turn, m, s_.start(h).clearance);
  const std::uint32_t to = bounds_beside(*throat, span, later, m, s_.end(h).clearance);
  edges_[h / 2].span.at_start = h % 2 == 0 ? from : to;
  edges_[h / 2].span.at_end = h % 2 == 0 ? to : from;
}

void Planner::yield_below(std::uint32_t h, const Span& span, Turn turn) {
  const Throat* throat = throat_at(h / 2);
  if (throat == nullptr || span.pairs != throat->pairs || span.pairs == 0) return;
  std::uint32_t g = none;
  for_each_leaving(Skeleton::twin(h), [&](std::uint32_t x) {
    if (edges_[x / 2].core) g = x;
  });
  const double reach = std::max(2 * turn.reach, o_.ramp);  // no disc of a wall touches the tip further away
  while (turn.past < reach - same_um) {
    const Span& own = edges_[g / 2].span;
    const double high = s_.start(g).clearance, length = s_.length(g / 2);
    if (own.pairs != span.pairs || own.middle || own.open) return;
    if (s_.end(g).clearance > high && length > one_place) return;  // what is shorter may rise by rounding
    if (turn.past + length > reach) g = split_core(g, (reach - turn.past) / length);
    const double m = std::min(1.0, slope(g / 2));
    const Turn later{turn.reach, turn.past + s_.length(g / 2)};
    Span& cut = edges_[g / 2].span;
    std::uint32_t &from = g % 2 == 0 ? cut.at_start : cut.at_end, &to = g % 2 == 0 ? cut.at_end : cut.at_start;
    // Where another tip is nearer they have yielded more already.
    const auto yielded = [&](std::uint32_t bounds, const Turn& at, double clearance) {
      const auto last = static_cast<std::uint32_t>(span.pairs);
      const std::uint32_t beside = bounds_beside({span.pairs, bounds}, span, at, m, clearance);
      return out_.bounds[beside + last] < out_.bounds[bounds + last] ? beside : bounds;
    };
    from = yielded(from, turn, high);
    to = yielded(to, later, s_.end(g).clearance);
    turn = later;
    const std::uint32_t next = onward(g);
    if (next == g) return;
    g = next;
  }
}

std::uint32_t Planner::split_core(std::uint32_t h, double t) {
  const std::uint32_t e = h / 2, f = split(e, h % 2 == 0 ? t : 1 - t);
  Span &first = edges_[e].span, &second = edges_[f].span;
  const auto at = static_cast<std::uint32_t>(out_.bounds.size());
  const double share = h % 2 == 0 ? t : 1 - t;
  for (std::size_t i = 0; i <= static_cast<std::size_t>(first.pairs); ++i) {
    const double a = out_.bounds[first.at_start + i], b = out_.bounds[first.at_end + i];
    out_.bounds.push_back(a + share * (b - a));
  }
  first.at_end = second.at_start = at;
  return h % 2 == 0 ? h : 2 * f + 1;
}

void Planner::run_into_corners() {
  find_throats();
  StopNowAndThen stop(256);
  for (const std::uint32_t n : peaks_) {
    stop.step();
    const double half = s_.nodes[n].clearance;
    Count count = count_for(w_, 2 * half, true);
    if (count.pairs > 0 && !count.middle && widest(count, 2 * half) > wide_bead()) count.middle = true;
    Span span;
    span.pairs = count.pairs;
    span.open = is_open(w_, count);
    span.at_start = span.at_end = bounds_at(count, {}, 0, half);
    descend_from(n, span, false);
    if (count.middle && !span.open) out_.dots.push_back(any_[n]);
  }
  // Mouths first, from the thickest part on: below them walls yield, and corners begin with what they have then.
  std::stable_sort(tops_.begin(), tops_.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return s_.nodes[a].clearance > s_.nodes[b].clearance; });
  for (const std::uint32_t n : tops_) leave_core(n, true);
  const auto nodes = static_cast<std::uint32_t>(any_.size());
  for (std::uint32_t n = 0; n < nodes; ++n) {
    stop.step();
    leave_core(n, false);
  }
}

void Planner::leave_core(std::uint32_t n, bool only_mouths) {
  std::uint32_t core = none;
  for_each_leaving(any_[n], [&](std::uint32_t h) {
    if (edges_[h / 2].core && (core == none || edges_[h / 2].span.pairs > edges_[core / 2].span.pairs)) core = h;
  });
  if (core == none) return;
  Span span = edges_[core / 2].span;
  const std::uint32_t at = core % 2 == 0 ? span.at_start : span.at_end;
  span.core = span.middle = false;
  span.at_start = span.at_end = at;
  descend_from(n, span, only_mouths);
}

void Planner::descend_from(std::uint32_t n, const Span& span, bool only_mouths) {
  for_each_leaving(any_[n], [&](std::uint32_t h) {
    if (!edges_[h / 2].core && !climbs_mouth(h) && (edges_[h / 2].mouth || !only_mouths))
      leave_.push_back({h, span, {}});
  });
  while (!leave_.empty()) {
    const Descent d = leave_.back();
    leave_.pop_back();
    descend(d.half, d.span, d.turn);
  }
}

Planner::Change Planner::next_change(const Span& span, const std::optional<Narrowing>& narrowing, double from,
                                     double low) const {
  Change out;
  if (span.open || span.pairs > 0) {
    const double end =
        span.open ? out_.bounds[span.at_start + static_cast<std::size_t>(span.pairs)] : turn_at(span, narrowing);
    if (end > low + same_um) out = {end, true};
  }
  if (narrowing)
    for (const double clearance : {narrowing->to, narrowing->from})
      if (clearance > std::max(out.clearance, low) + same_um && clearance < from - same_um) out = {clearance, false};
  return out;
}

void Planner::descend(std::uint32_t h, Span span, Turn turn) {
  const double sharp = sharp_from(h);
  const auto innermost = [&] { return out_.bounds[span.at_start + static_cast<std::size_t>(span.pairs)]; };
  const auto end_innermost = [&] {
    if (span.open) {
      span.open = false;
      return;
    }
    const double* b = &out_.bounds[span.at_start + static_cast<std::size_t>(--span.pairs)];
    turn = {(b[1] - b[0]) / 2, 0};
  };
  for (;;) {
    if (edges_[h / 2].reached) return;
    const double from = s_.start(h).clearance, to = s_.end(h).clearance, low = std::min(from, to);
    while (span.open && innermost() > from + same_um) end_innermost();
    auto narrowing = narrowing_of(span, sharp);
    while (span.pairs > 0 && !span.open && turn_at(span, narrowing) > from + same_um) {
      end_innermost();
      narrowing = narrowing_of(span, sharp);
    }
    const auto [cut, ends] = next_change(span, narrowing, from, low);
    std::uint32_t rest = h;
    if (cut >= 0 && from - to > same_um) {
      const double t = (from - cut) / (from - to);
      if (t > 1e-9) {
        const std::uint32_t e = h / 2, f = split(e, h % 2 == 0 ? t : 1 - t);
        if (h % 2 == 1) h = 2 * f + 1;
        rest = s_.halves[h].next;
      }
    }
    if (rest == h && ends) {  // begins exactly where a bead ends
      end_innermost();
      continue;
    }
    edges_[h / 2].span = in_corner(h, span, narrowing);
    if (edges_[h / 2].mouth) fill_beside(h, turn);
    turn.past += s_.length(h / 2);
    edges_[h / 2].reached = true;
    if (rest != h) {
      if (ends) end_innermost();
      h = rest;
      continue;
    }
    const std::uint32_t back = Skeleton::twin(h);
    bool at_core = false;
    for_each_leaving(back, [&](std::uint32_t g) { at_core = at_core || edges_[g / 2].core; });
    if (at_core) {
      if (edges_[h / 2].mouth) yield_below(h, span, turn);
      return;
    }
    for_each_leaving(back, [&](std::uint32_t g) {
      if (g != back && !climbs_mouth(g)) leave_.push_back({g, span, turn});
    });
    return;
  }
}

}  // namespace weft::walls
