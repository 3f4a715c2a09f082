// SPDX-License-Identifier: GPL-3.0-or-later
// How walls get narrower where they bend around a sharp corner.
#include "walls/planner.h"

#include <algorithm>
#include <cmath>

namespace weft::walls {

double Planner::sharp_from(std::uint32_t h) const {
  if (o_.corner_width >= 1 || edges_[h / 2].mouth) return 0;
  const std::uint32_t first = h;
  for (;;) {
    if (s_.end(h).clearance >= s_.start(h).clearance) return 0;
    std::uint32_t next = none;
    int ways = 0;
    for_each_leaving(Skeleton::twin(h), [&](std::uint32_t g) {
      if (g != Skeleton::twin(h)) next = g, ++ways;
    });
    if (ways == 0) break;
    if (ways > 1 || edges_[next / 2].core || edges_[next / 2].mouth) return 0;
    h = next;
  }
  const double sine = slope(h / 2);
  if (sine > sharp_sine) return 0;
  // On the way straight to the tip the clearance falls as that of the last edge does.
  constexpr double straight_um = 2;
  const auto& tip = s_.end(h);
  const auto straight = [&](const Skeleton::Node& node) {
    return std::abs(node.clearance - tip.clearance - sine * distance(node.at, tip.at)) < straight_um;
  };
  std::uint32_t g = first;
  while (g != h && !straight(s_.start(g))) g = s_.halves[g].next;
  return s_.start(g).clearance;
}

std::optional<Planner::Narrowing> Planner::narrowing_of(const Span& span, double sharp_from) const {
  if (span.pairs == 0 || sharp_from <= 0) return {};
  const double* b = &out_.bounds[span.at_start + static_cast<std::size_t>(span.pairs) - 1];
  // Outer walls of every width get as sharp as one of nominal width.
  const double width = span.pairs == 1 ? std::min(b[1] - b[0], w_.outer) : b[1] - b[0];
  const Narrowing out{std::min(b[1], sharp_from), b[0] + o_.corner_width * width};
  if (o_.corner_width * width < o_.narrowest || out.from < out.to + least_narrowing) return {};
  return out;
}

double Planner::turn_at(const Span& span, const std::optional<Narrowing>& narrowing) const {
  const double* b = &out_.bounds[span.at_start + static_cast<std::size_t>(span.pairs) - 1];
  return (b[0] + (narrowing ? narrowing->to : b[1])) / 2;
}

Span Planner::in_corner(std::uint32_t h, const Span& span, const std::optional<Narrowing>& narrowing) {
  Span out = span;
  out.mouth = edges_[h / 2].mouth;
  if (!narrowing || s_.start(h).clearance > narrowing->from + same_um) return out;
  const double own = out_.bounds[span.at_start + static_cast<std::size_t>(span.pairs)];
  const double above = narrowing->inner_bound(own, s_.start(h).clearance);
  const double below = narrowing->inner_bound(own, s_.end(h).clearance);
  const std::uint32_t start = bounds_up_to(span, above), end = bounds_up_to(span, below);
  out.at_start = h % 2 == 0 ? start : end;
  out.at_end = h % 2 == 0 ? end : start;
  out.narrows = above > below + same_um;
  return out;
}

std::uint32_t Planner::bounds_up_to(const Span& span, double innermost) {
  const auto at = static_cast<std::uint32_t>(out_.bounds.size());
  for (std::uint32_t i = 0; i < static_cast<std::uint32_t>(span.pairs); ++i) {
    const double bound = out_.bounds[span.at_start + i];
    out_.bounds.push_back(bound);
  }
  out_.bounds.push_back(innermost);
  return at;
}

}  // namespace weft::walls
