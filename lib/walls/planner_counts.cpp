// SPDX-License-Identifier: GPL-3.0-or-later
// How many beads lie side by side along the core.
#include "core/stop.h"
#include "walls/planner.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace weft::walls {

std::uint32_t Planner::split(std::uint32_t e, double t) {
  const std::uint32_t f = s_.split(e, t);
  any_[s_.halves[2 * f + 1].from] = 2 * f + 1;
  any_.push_back(2 * f);
  edges_.push_back(Edge(edges_[e]));
  return f;
}

double Planner::crowded(int beads) {
  const auto slot = static_cast<std::size_t>(beads);
  if (slot >= crowded_.size()) crowded_.resize(slot + 1);
  if (crowded_[slot]) return *crowded_[slot];
  const double most = beads == 2 ? outer_spread * w_.outer : wide_bead();  // the outer wall is to keep its width
  double low = threshold(w_, beads), high = threshold(w_, beads + 1);
  for (int i = 0; i < 30; ++i) {
    const double middle = (low + high) / 2;
    (widest({beads / 2, false}, middle) > most ? high : low) = middle;
  }
  crowded_[slot] = high;
  return high;
}

Count Planner::count_of(std::uint32_t e) {
  const double thickness = s_.start(2 * e).clearance + s_.end(2 * e).clearance;
  if (!edges_[e].steep) return count_for(w_, thickness, false);
  const Count even = count_for(w_, thickness, true);
  return !even.middle && even.pairs > 0 && thickness >= crowded(even.beads()) ? count_for(w_, thickness, false) : even;
}

void Planner::cut_at_thresholds() {
  const auto edges = static_cast<std::uint32_t>(edges_.size());
  std::vector<double> cuts;
  StopNowAndThen stop(256);
  for (std::uint32_t e = 0; e < edges; ++e) {
    stop.step();
    if (!edges_[e].core) continue;
    const double a = 2 * s_.start(2 * e).clearance, b = 2 * s_.end(2 * e).clearance;
    const double low = std::min(a, b), high = std::max(a, b);
    if (high - low < same_um) continue;
    cuts.clear();
    for (int n = std::max(0, count_for(w_, low, false).beads() - 1); n <= 2 * w_.walls; ++n) {
      const bool late = edges_[e].steep && n % 2 == 0 && n > 0 && n < 2 * w_.walls;
      const double t = late ? crowded(n) : threshold(w_, n);
      if (t >= high) break;
      if (t > low) cuts.push_back((t - low) / (high - low));
    }
    if (a > b) {
      for (double& t : cuts) t = 1 - t;
      std::reverse(cuts.begin(), cuts.end());
    }
    double done = 0;
    std::uint32_t rest = e;
    for (const double t : cuts) {
      rest = split(rest, (t - done) / (1 - done));
      done = t;
    }
  }
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    stop.step();
    if (edges_[e].core) edges_[e].count = count_of(e);
  }
}

double Planner::widest(Count count, double thickness) {
  scratch_.resize(static_cast<std::size_t>(count.pairs) + 1);
  bounds_for(w_, count, thickness / 2, scratch_.data());
  double most = count.middle ? thickness - 2 * scratch_.back() : 0;
  for (std::size_t i = 1; i < scratch_.size(); ++i) most = std::max(most, scratch_[i] - scratch_[i - 1]);
  return most;
}

std::uint32_t Planner::CountRegions::of(std::uint32_t edge) {
  while (root[edge] != edge) edge = root[edge] = root[root[edge]];
  return edge;
}

std::uint32_t Planner::next_core(std::uint32_t h) const {
  std::uint32_t g = s_.halves[h].next;
  while (!edges_[g / 2].core) g = s_.halves[Skeleton::twin(g)].next;
  return g;
}

Planner::CountRegions Planner::regions_of_counts() const {
  const auto edges = static_cast<std::uint32_t>(edges_.size());
  CountRegions out;
  out.root.resize(edges);
  std::iota(out.root.begin(), out.root.end(), 0U);
  StopNowAndThen stop(256);
  for (std::uint32_t h = 0; h < s_.halves.size(); ++h) {
    stop.step();
    if (!edges_[h / 2].core) continue;
    const std::uint32_t g = next_core(h);
    if (edges_[g / 2].count == edges_[h / 2].count) {
      const std::uint32_t here = out.of(h / 2), there = out.of(g / 2);
      out.root[std::max(here, there)] = std::min(here, there);
    }
  }
  out.length.assign(edges, 0), out.low.assign(edges, 1e18), out.high.assign(edges, 0), out.ends.assign(edges, 0);
  for (std::uint32_t e = 0; e < edges; ++e) {
    if (!edges_[e].core) continue;
    const std::uint32_t r = out.of(e);
    out.length[r] += s_.length(e);
    for (const std::uint32_t h : {2 * e, 2 * e + 1}) {
      out.low[r] = std::min(out.low[r], 2 * s_.start(h).clearance);
      out.high[r] = std::max(out.high[r], 2 * s_.start(h).clearance);
    }
  }
  return out;
}

std::vector<Planner::Border> Planner::borders_of(CountRegions& regions) const {
  std::vector<Border> out;
  StopNowAndThen stop(256);
  for (std::uint32_t h = 0; h < s_.halves.size(); ++h) {
    stop.step();
    if (!edges_[h / 2].core) continue;
    const std::uint32_t here = regions.of(h / 2), there = regions.of(next_core(h) / 2);
    if (here == there) continue;
    out.push_back({here, there});
    out.push_back({there, here});
  }
  for (const Border& b : out) regions.ends[b.region] += 1;
  const auto& length = regions.length;
  std::sort(out.begin(), out.end(), [&](const Border& p, const Border& q) {
    if (length[p.region] != length[q.region]) return length[p.region] < length[q.region];
    if (p.region != q.region) return p.region < q.region;
    return length[p.other] > length[q.other];
  });
  return out;
}

bool Planner::gives_way(const CountRegions& regions, const Border& b) {
  const double length = regions.length[b.region], low = regions.low[b.region], high = regions.high[b.region];
  if (length >= o_.filter || regions.length[b.other] <= length) return false;
  const Count mine = edges_[b.region].count, other = edges_[b.other].count;
  if (std::abs(mine.beads() - other.beads()) != 1 || mine.beads() == 0 || other.beads() == 0) return false;
  const double t = threshold(w_, std::min(mine.beads(), other.beads()));
  const double deviation = other.beads() > mine.beads() ? t - low : high - t;
  if (deviation <= o_.filter_deviation) return true;
  if (mine.beads() < other.beads() || length >= regions.ends[b.region] / 2 * w_.inner) return false;
  // Where several parts meet there is a little more room than in each: no wall turns back in that.
  const bool junction = regions.ends[b.region] > 5;
  const double widest_there = widest(other, high);
  if (other.pairs > 0) return junction && widest_there < wide_bead();
  return widest_there < (junction && high < 1.5 * regions.low[b.other] ? w_.most : wide_bead());
}

void Planner::filter() {
  for (int round = 0; round < 4; ++round) {
    auto regions = regions_of_counts();
    enum class Fate : std::uint8_t { open, stays, changes };
    std::vector<Fate> fate(edges_.size());
    std::vector<Count> changed(edges_.size());
    bool any = false;
    for (const Border& b : borders_of(regions)) {
      if (fate[b.region] != Fate::open || fate[b.other] != Fate::open || !gives_way(regions, b)) continue;
      fate[b.region] = Fate::changes;
      fate[b.other] = Fate::stays;
      changed[b.region] = edges_[b.other].count;
      any = true;
    }
    if (!any) return;
    for (std::uint32_t e = 0; e < edges_.size(); ++e)
      if (edges_[e].core && fate[regions.of(e)] == Fate::changes) edges_[e].count = changed[regions.of(e)];
  }
}

}  // namespace weft::walls
