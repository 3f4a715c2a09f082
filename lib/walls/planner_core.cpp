// SPDX-License-Identifier: GPL-3.0-or-later
// What runs into corners and what does not.
#include "core/stop.h"
#include "walls/planner.h"

#include <algorithm>
#include <cmath>

namespace weft::walls {

void Planner::find_steep() {
  const double single = threshold(w_, 1) / 2 - 2 * same_um;  // rounding must not decide what there is room for
  for (std::uint32_t e = 0, edges = static_cast<std::uint32_t>(s_.edge_count()); e < edges; ++e) {
    const double a = s_.start(2 * e).clearance, b = s_.end(2 * e).clearance, m = slope(e);
    if (m > o_.steep && m <= o_.steep_tip && std::min(a, b) < single - same_um && std::max(a, b) > single + same_um)
      s_.split(e, (single - a) / (b - a));
  }
  edges_.assign(s_.edge_count(), {});
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    const bool tip = std::max(s_.start(2 * e).clearance, s_.end(2 * e).clearance) <= single + same_um;
    edges_[e].steep = slope(e) > (tip ? o_.steep_tip : o_.steep);
  }
}

void Planner::find_core() {
  find_steep();
  const auto edges = static_cast<std::uint32_t>(s_.edge_count());
  std::vector<int> degree(s_.nodes.size(), 0);
  std::vector<double> shallow(s_.nodes.size(), 0);  // length of flat stretches cut off so far
  for (std::uint32_t e = 0; e < edges; ++e) {
    ++degree[s_.halves[2 * e].from];
    ++degree[s_.halves[2 * e + 1].from];
  }
  any_.resize(s_.nodes.size());
  for (std::uint32_t h = 0; h < s_.halves.size(); ++h) any_[s_.halves[h].from] = h;
  // From the thinnest up, so that what is left last of a part that is all corners is its thickest place.
  const auto thicker = [&](std::uint32_t a, std::uint32_t b) {
    return s_.nodes[a].clearance != s_.nodes[b].clearance ? s_.nodes[a].clearance > s_.nodes[b].clearance : a > b;
  };
  std::vector<std::uint32_t> leaves;
  for (std::uint32_t n = 0; n < degree.size(); ++n)
    if (degree[n] == 1) leaves.push_back(n);
  std::make_heap(leaves.begin(), leaves.end(), thicker);
  const auto add_leaf = [&](std::uint32_t n) {
    leaves.push_back(n);
    std::push_heap(leaves.begin(), leaves.end(), thicker);
  };
  StopNowAndThen stop(256);
  while (!leaves.empty()) {
    stop.step();
    std::pop_heap(leaves.begin(), leaves.end(), thicker);
    const std::uint32_t n = leaves.back();
    leaves.pop_back();
    if (degree[n] != 1) continue;
    std::uint32_t h = any_[n];
    for_each_leaving(any_[n], [&](std::uint32_t g) {
      if (edges_[g / 2].core) h = g;
    });
    const std::uint32_t m = s_.to(h);
    const double rise = s_.nodes[m].clearance - s_.nodes[n].clearance;
    if (rise < -dip_share * s_.nodes[n].clearance) continue;  // the thickest place of its surroundings stays
    double flat = shallow[n];
    if (!edges_[h / 2].steep || rise < 0) flat += s_.length(h / 2);
    if (flat > stub_share * s_.nodes[m].clearance) continue;
    edges_[h / 2].core = false;
    --degree[n];
    shallow[m] = std::max(shallow[m], flat);
    if (--degree[m] == 1) add_leaf(m);
    if (degree[m] == 0) peaks_.push_back(m);
  }
  cut_bent_tips(degree);
  cut_mouths(degree);
}

void Planner::cut_mouths(std::vector<int>& degree) {
  const auto climbs = [&](std::uint32_t h) {
    return edges_[h / 2].core && !edges_[h / 2].mouth && edges_[h / 2].steep &&
           s_.end(h).clearance > s_.start(h).clearance;
  };
  // All that are found in one look are cut together, so that it does not matter which is found first; where one is cut,
  // another may lead on.
  std::vector<std::uint8_t> seen(edges_.size());
  std::vector<std::uint32_t> run;
  for (std::size_t done = 0;;) {
    std::fill(seen.begin(), seen.end(), 0);
    for (std::uint32_t start = 0; start < s_.halves.size(); ++start) {
      if (seen[start / 2] || !climbs(start)) continue;
      std::uint32_t below = start;  // begins there: what leads to it does not climb
      for (std::uint32_t h = onward(Skeleton::twin(start)); h != Skeleton::twin(below) && climbs(Skeleton::twin(h));
           h = onward(h))
        below = Skeleton::twin(h);
      run.assign(1, below);
      for (std::uint32_t h = onward(below); h != run.back() && climbs(h); h = onward(h)) run.push_back(h);
      for (const std::uint32_t h : run) seen[h / 2] = 1;
      const std::uint32_t low = s_.halves[below].from, high = s_.to(run.back());
      const int more = count_for(w_, 2 * s_.nodes[high].clearance, true).beads();
      int fewer = count_for(w_, 2 * s_.nodes[low].clearance, false).beads();
      // Below what climbs so steeply there may be room for one bead more than in the arm. That is none of the arm's:
      // from there walls come towards it, if those of another arm that has as many go on up there.
      if (const int arm = beads_of_arm(Skeleton::twin(below)); arm > 0 && leads_to_arm(run.back(), more)) fewer = arm;
      const double rise = s_.nodes[high].clearance - s_.nodes[low].clearance;
      const bool splits = fewer == 1 && 2 * s_.nodes[high].clearance > wide_bead() && rise > 0.3 * w_.inner;
      if (more - fewer >= (splits ? 1 : 2)) runs_.push_back(run);
    }
    if (done == runs_.size()) break;
    for (; done < runs_.size(); ++done) {
      for (const std::uint32_t h : runs_[done]) {
        edges_[h / 2].core = false;
        edges_[h / 2].mouth = true;
        --degree[s_.halves[h].from];
        --degree[s_.to(h)];
      }
      tops_.push_back(s_.to(runs_[done].back()));
    }
  }
  for (const std::uint32_t n : tops_) {
    bool peak = degree[n] == 0;
    for_each_leaving(any_[n], [&](std::uint32_t h) { peak = peak && !climbs_mouth(h); });
    if (peak && std::find(peaks_.begin(), peaks_.end(), n) == peaks_.end()) peaks_.push_back(n);
  }
}

int Planner::beads_of_arm(std::uint32_t h) const {
  if (s_.end(h).clearance > s_.start(h).clearance + same_um) return 0;
  const auto beads = [&] { return count_for(w_, 2 * s_.end(h).clearance, false).beads(); };
  double gentle = 0;  // way down that is not steep
  for (std::uint32_t g = onward(h); g != h && gentle < o_.filter && s_.end(g).clearance < s_.start(g).clearance;
       g = onward(h)) {
    h = g;
    if (!edges_[h / 2].steep) gentle += s_.length(h / 2);
  }
  const int there = beads();
  double length = 0;
  for (std::uint32_t g = onward(h); g != h && length < o_.filter; g = onward(h)) {
    h = g;
    if (beads() != there) return 0;
    length += s_.length(h / 2);
  }
  return there;
}

bool Planner::leads_to_arm(std::uint32_t h, int beads) const {
  bool found = false;
  for_each_leaving(Skeleton::twin(h), [&](std::uint32_t g) {
    found = found || (edges_[g / 2].core && g != Skeleton::twin(h) && beads_of_arm(g) >= beads);
  });
  return found;
}

void Planner::cut_bent_tips(std::vector<int>& degree) {
  constexpr double most_bend_cos = 0.82;
  for (std::uint32_t n = 0; n < degree.size(); ++n) {
    if (degree[n] != 1 || s_.nodes[n].clearance > 5) continue;
    std::uint32_t h = any_[n];
    for_each_leaving(any_[n], [&](std::uint32_t g) {
      if (edges_[g / 2].core) h = g;
    });
    std::vector<std::uint32_t> chain;
    while (edges_[h / 2].steep) {
      chain.push_back(h);
      if (degree[s_.to(h)] != 2) break;
      const std::uint32_t g = onward(h);
      if (g == h) break;
      const Place u = direction(h), v = direction(g);
      if (!edges_[g / 2].steep && u.x * v.x + u.y * v.y < most_bend_cos) {
        for (const std::uint32_t c : chain) edges_[c / 2].core = false;
        degree[n] = 0;
        degree[s_.to(h)] = 1;
        break;
      }
      h = g;
    }
  }
}

Place Planner::direction(std::uint32_t h) const {
  const Place a = s_.start(h).at, b = s_.end(h).at;
  const double d = std::max(1e-9, std::hypot(b.x - a.x, b.y - a.y));
  return {(b.x - a.x) / d, (b.y - a.y) / d};
}

}  // namespace weft::walls
