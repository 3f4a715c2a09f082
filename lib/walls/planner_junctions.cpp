// SPDX-License-Identifier: GPL-3.0-or-later
// Small places where thick arms meet: the walls pass, and one bead in their middle fills what they leave.
#include "walls/planner.h"

#include <algorithm>

namespace weft::walls {

void Planner::pass_junctions() {
  for (std::uint32_t n = 0; n < any_.size(); ++n) {
    auto summit = steep_around(n) ? summit_at(n) : std::nullopt;
    if (!summit) continue;
    auto& [nodes, edges, arms] = *summit;
    if (arms.size() < fewest_arms || arms.size() > most_arms) continue;
    double walls = 0, room = 0;  // half the thickness that the walls fill, and that there is
    for (auto& arm : arms) {
      down_to_level(arm);
      walls = std::max(walls, s_.end(arm.back()).clearance);
    }
    for (const std::uint32_t m : nodes) room = std::max(room, s_.nodes[m].clearance);
    Count count;
    if (2 * (room - walls) > wide_bead() || !alike(arms, count)) continue;
    if (widest(count, 2 * room) < wide_bead()) continue;
    for (const auto& arm : arms) {
      const double low = s_.end(arm.back()).clearance, high = s_.start(arm.front()).clearance;
      for (const std::uint32_t h : arm) pass(h / 2, count, {low, high, low, walls});
    }
    for (const std::uint32_t e : edges) pass(e, count, {0, room, walls, walls});
    const auto& passed = nodes;
    std::erase_if(peaks_, [&](std::uint32_t m) { return std::find(passed.begin(), passed.end(), m) != passed.end(); });
  }
}

bool Planner::steep_around(std::uint32_t node) const {
  bool up = false, down = false;
  for_each_leaving(any_[node], [&](std::uint32_t h) {
    if (!is_climb(h / 2) || (!edges_[h / 2].core && !edges_[h / 2].mouth)) return;
    (s_.end(h).clearance < s_.start(h).clearance ? down : up) = true;
  });
  return up != down;
}

std::optional<Planner::Summit> Planner::summit_at(std::uint32_t node) const {
  Summit out;
  auto& nodes = out.nodes;
  auto& edges = out.edges;
  double length = 0;
  nodes.push_back(node);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    bool up = false, down = false;
    for_each_leaving(any_[nodes[i]], [&](std::uint32_t h) {
      const std::uint32_t e = h / 2;
      if ((!edges_[e].core && !edges_[e].mouth) || std::find(edges.begin(), edges.end(), e) != edges.end()) return;
      if (is_climb(e) && s_.end(h).clearance < s_.start(h).clearance) {
        out.arms.push_back({h});
        down = true;
        return;
      }
      up = up || is_climb(e);
      edges.push_back(e);
      length += s_.length(e);
      if (std::find(nodes.begin(), nodes.end(), s_.to(h)) == nodes.end()) nodes.push_back(s_.to(h));
    });
    if ((up && down) || length >= longest_summit * w_.inner) return {};  // on a slope, or wide
  }
  return out;
}

void Planner::down_to_level(std::vector<std::uint32_t>& arm) const {
  for (;;) {
    std::uint32_t found = none;
    int ways = 0;
    for_each_leaving(Skeleton::twin(arm.back()), [&](std::uint32_t g) {
      if (g != Skeleton::twin(arm.back()) && (edges_[g / 2].core || edges_[g / 2].mouth)) found = g, ++ways;
    });
    if (ways != 1 || s_.end(found).clearance >= s_.start(found).clearance) return;
    if (!edges_[found / 2].steep && !edges_[found / 2].count.middle) return;
    arm.push_back(found);
  }
}

bool Planner::alike(const std::vector<std::vector<std::uint32_t>>& arms, Count& count) {
  int ways = 0;
  bool same = true;
  for (const auto& arm : arms)
    for_each_leaving(Skeleton::twin(arm.back()), [&](std::uint32_t h) {
      if (!edges_[h / 2].core || h == Skeleton::twin(arm.back())) return;
      same = same && (ways == 0 || edges_[h / 2].count == count);
      count = edges_[h / 2].count;
      ++ways;
    });
  return same && ways == static_cast<int>(arms.size()) && count.pairs > 0 && !count.middle;
}

void Planner::pass(std::uint32_t e, Count count, Passage passage) {
  Edge& edge = edges_[e];
  edge.core = true;
  edge.mouth = false;
  edge.count = count;
  edge.passage = static_cast<std::uint32_t>(passages_.size());
  passages_.push_back(passage);
}

double Planner::walled(std::uint32_t e, double clearance) const {
  if (!passes(e)) return clearance;
  const Passage& p = passages_[edges_[e].passage];
  if (p.high - p.low < same_um) return p.walls_high;
  return p.walls_low + (p.walls_high - p.walls_low) * (clearance - p.low) / (p.high - p.low);
}

}  // namespace weft::walls
