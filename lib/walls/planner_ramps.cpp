// SPDX-License-Identifier: GPL-3.0-or-later
// How one count of beads passes into another, and where the beads of the core lie.
#include "walls/planner.h"

#include <algorithm>
#include <cmath>

namespace weft::walls {

void Planner::ramps() {
  // The stretch of equal count that begins with a half, until its count changes, branches, or the core ends. A ramp
  // at one end of an edge leaves its other end to a new edge, which is looked at in its turn.
  for (std::uint32_t h = 0; h < s_.halves.size(); ++h) {
    if (!edges_[h / 2].core) continue;
    const Count mine = edges_[h / 2].count;
    Count other = mine;
    for_each_leaving(h, [&](std::uint32_t g) {
      if (!edges_[g / 2].core || edges_[g / 2].count == mine) return;
      if (other == mine || edges_[g / 2].count.beads() > other.beads())
        other = edges_[g / 2].count;  // whatever comes first
    });
    if (other == mine || other.beads() == 0 || mine.beads() == 0) continue;
    const double reach = std::min(o_.ramp / 2, stretch(h) / 2);
    if (reach > same_um) blend_along(h, other, reach);
  }
}

std::uint32_t Planner::onward(std::uint32_t h) const {
  std::uint32_t found = h;
  int count = 0;
  for_each_leaving(Skeleton::twin(h), [&](std::uint32_t g) {
    if (g != Skeleton::twin(h) && edges_[g / 2].core) found = g, ++count;
  });
  return count == 1 ? found : h;
}

double Planner::stretch(std::uint32_t h) const {
  double length = 0;
  const Count mine = edges_[h / 2].count;
  for (;;) {
    length += s_.length(h / 2);
    if (length > 2 * o_.ramp) return length;
    const std::uint32_t g = onward(h);
    if (g == h || edges_[g / 2].count != mine) return g == h ? 2 * length : length;  // a free end takes the whole ramp
    h = g;
  }
}

void Planner::blend_along(std::uint32_t h, Count other, double reach) {
  double done = 0;
  const Count mine = edges_[h / 2].count;
  while (done < reach - same_um) {
    if (edges_[h / 2].count != mine || edges_[h / 2].blend.at_start > 0 || edges_[h / 2].blend.at_end > 0) return;
    const double length = s_.length(h / 2);
    if (done + length > reach + same_um) {  // ends within this edge
      const double t = (reach - done) / length;
      const std::uint32_t e = h / 2, f = split(e, h % 2 == 0 ? t : 1 - t);
      if (h % 2 == 1) h = 2 * f + 1;
    }
    const double from = 0.5 * (1 - done / reach);
    done += s_.length(h / 2);
    const double to = std::max(0.0, 0.5 * (1 - done / reach));
    edges_[h / 2].blend = h % 2 == 0 ? Blend{other, from, to} : Blend{other, to, from};
    const std::uint32_t g = onward(h);
    if (g == h) return;
    h = g;
  }
}

void Planner::set_core_bounds(std::uint32_t e) {
  if (!edges_[e].core) return;
  Span& span = edges_[e].span;
  const Blend& blend = edges_[e].blend;
  const bool blended = blend.at_start > 0 || blend.at_end > 0;
  Count shape = edges_[e].count;
  // Towards one bead more a middle opens; a middle that will split stays one until the change itself.
  if (blended && blend.other.pairs == shape.pairs && blend.other.middle) shape.middle = true;
  span.core = true;
  span.pairs = shape.pairs;
  span.open = is_open(w_, shape);
  span.middle = passes(e) || (shape.middle && !span.open && edges_[e].count.beads() > 0);
  span.at_start =
      bounds_at(edges_[e].count, blend.other, blended ? blend.at_start : 0, walled(e, s_.start(2 * e).clearance));
  span.at_end = bounds_at(edges_[e].count, blend.other, blended ? blend.at_end : 0, walled(e, s_.end(2 * e).clearance));
}

std::uint32_t Planner::bounds_at(Count mine, Count other, double share, double half) {
  const auto at = static_cast<std::uint32_t>(out_.bounds.size());
  out_.bounds.resize(at + static_cast<std::size_t>(mine.pairs) + 1);
  bounds_for(w_, mine, half, &out_.bounds[at]);
  if (share > 0) {
    scratch_.resize(static_cast<std::size_t>(other.pairs) + 1);
    bounds_for(w_, other, half, scratch_.data());
    for (int i = 1; i <= std::min(mine.pairs, other.pairs); ++i) {
      double& b = out_.bounds[at + static_cast<std::size_t>(i)];
      b += share * (scratch_[static_cast<std::size_t>(i)] - b);
    }
    for (int i = std::min(mine.pairs, other.pairs) + 1; i <= mine.pairs; ++i) {
      double& b = out_.bounds[at + static_cast<std::size_t>(i)];
      b = std::max(b, out_.bounds[at + static_cast<std::size_t>(i) - 1]);
    }
  }
  return at;
}

}  // namespace weft::walls
