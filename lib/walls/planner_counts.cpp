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

void Planner::filter() {
  for (int round = 0; round < 4; ++round) {
    const auto edges = static_cast<std::uint32_t>(edges_.size());
    std::vector<std::uint32_t> root(edges);
    std::iota(root.begin(), root.end(), 0U);
    auto find = [&](std::uint32_t e) {
      while (root[e] != e) e = root[e] = root[root[e]];
      return e;
    };
    StopNowAndThen stop(256);
    for (std::uint32_t h = 0; h < s_.halves.size(); ++h) {
      stop.step();
      if (!edges_[h / 2].core) continue;
      std::uint32_t g = s_.halves[h].next;  // the next core edge around the end
      while (!edges_[g / 2].core) g = s_.halves[Skeleton::twin(g)].next;
      if (edges_[g / 2].count == edges_[h / 2].count)
        root[std::max(find(g / 2), find(h / 2))] = std::min(find(g / 2), find(h / 2));
    }
    std::vector<double> length(edges, 0), low(edges, 1e18), high(edges, 0);
    for (std::uint32_t e = 0; e < edges; ++e) {
      if (!edges_[e].core) continue;
      const std::uint32_t r = find(e);
      length[r] += s_.length(e);
      for (const std::uint32_t h : {2 * e, 2 * e + 1}) {
        low[r] = std::min(low[r], 2 * s_.start(h).clearance);
        high[r] = std::max(high[r], 2 * s_.start(h).clearance);
      }
    }
    struct Border {
      std::uint32_t region, other;
    };
    std::vector<Border> borders;
    for (std::uint32_t h = 0; h < s_.halves.size(); ++h) {
      stop.step();
      if (!edges_[h / 2].core) continue;
      std::uint32_t g = s_.halves[h].next;
      while (!edges_[g / 2].core) g = s_.halves[Skeleton::twin(g)].next;
      if (find(g / 2) != find(h / 2)) {
        borders.push_back({find(h / 2), find(g / 2)});
        borders.push_back({find(g / 2), find(h / 2)});
      }
    }
    std::sort(borders.begin(), borders.end(), [&](const Border& p, const Border& q) {
      if (length[p.region] != length[q.region]) return length[p.region] < length[q.region];
      if (p.region != q.region) return p.region < q.region;
      return length[p.other] > length[q.other];
    });
    std::vector<double> mouths(edges, 0);  // ends of each region, twice
    for (const Border& b : borders) mouths[b.region] += 1;
    std::vector<std::uint8_t> fixed(edges, 0);
    std::vector<Count> changed(edges);
    bool any = false;
    for (const Border& b : borders) {
      if (length[b.region] >= o_.filter || fixed[b.region] || fixed[b.other]) continue;
      if (length[b.other] <= length[b.region]) continue;
      const Count mine = edges_[b.region].count, other = edges_[b.other].count;
      if (std::abs(mine.beads() - other.beads()) != 1) continue;
      const double t = threshold(w_, std::min(mine.beads(), other.beads()));
      if (mine.beads() == 0 || other.beads() == 0) continue;
      const double deviation = other.beads() > mine.beads() ? t - low[b.region] : high[b.region] - t;
      // Where several parts meet there is a little more room than in each: no wall turns back in that.
      const bool junction = mouths[b.region] > 5;
      const double widest_there = widest(other, high[b.region]);
      const bool cramped =
          mine.beads() > other.beads() && length[b.region] < mouths[b.region] / 2 * w_.inner &&
          (other.pairs > 0 ? junction && widest_there < wide_bead()
                           : widest_there < (junction && high[b.region] < 1.5 * low[b.other] ? w_.most : wide_bead()));
      if (deviation > o_.filter_deviation && !cramped) continue;
      fixed[b.region] = fixed[b.other] = 1;
      changed[b.region] = other;
      fixed[b.region] = 2;
      any = true;
    }
    if (!any) return;
    for (std::uint32_t e = 0; e < edges; ++e)
      if (edges_[e].core && fixed[find(e)] == 2) edges_[e].count = changed[find(e)];
  }
}

void Planner::open_needless_mouths() {
  for (const auto& run : runs_) {
    Count below, above;
    int ways_below = 0, ways_above = 0;
    for_each_leaving(run.front(), [&](std::uint32_t h) {
      if (edges_[h / 2].core) below = edges_[h / 2].count, ++ways_below;
    });
    for_each_leaving(Skeleton::twin(run.back()), [&](std::uint32_t h) {
      if (edges_[h / 2].core) above = edges_[h / 2].count, ++ways_above;
    });
    if (ways_below != 1 || ways_above == 0 || below != above) continue;
    for (const std::uint32_t h : run) {
      edges_[h / 2].core = true;
      edges_[h / 2].mouth = false;
      edges_[h / 2].count = below;
    }
  }
}

}  // namespace weft::walls
