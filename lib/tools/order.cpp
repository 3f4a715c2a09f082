// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/order.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>

namespace weft::tools {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr std::size_t most_exact = 10;

/// The cheapest way through all tools of a set from each to each of them.
class Paths {
 public:
  Paths(const std::vector<ToolId>& set, const Costs& costs) : set_(set), size_(set.size()) {
    if (size_ > most_exact) return;
    const std::size_t masks = std::size_t{1} << size_;
    for (std::size_t first = 0; first < size_; ++first) {
      auto& least = least_.emplace_back(masks * size_, never);
      auto& before = before_.emplace_back(masks * size_, 0);
      least[(std::size_t{1} << first) * size_ + first] = 0;
      for (std::size_t mask = 0; mask < masks; ++mask)
        for (std::size_t last = 0; last < size_; ++last) {
          const double now = least[mask * size_ + last];
          if (now == never) continue;
          for (std::size_t next = 0; next < size_; ++next) {
            if ((mask >> next & 1U) != 0) continue;
            const std::size_t to = (mask | std::size_t{1} << next) * size_ + next;
            const double sum = now + costs[set[last]][set[next]];
            if (sum < least[to]) least[to] = sum, before[to] = last;
          }
        }
    }
  }

  bool exact() const { return size_ <= most_exact; }
  double cost(std::size_t first, std::size_t last) const { return least_[first][whole() * size_ + last]; }

  std::vector<ToolId> way(std::size_t first, std::size_t last) const {
    std::vector<ToolId> out;
    for (std::size_t mask = whole(), at = last;;) {
      out.push_back(set_[at]);
      if (at == first && mask == std::size_t{1} << first) break;
      const std::size_t from = before_[first][mask * size_ + at];
      mask &= ~(std::size_t{1} << at), at = from;
    }
    std::reverse(out.begin(), out.end());
    return out;
  }

 private:
  std::size_t whole() const { return (std::size_t{1} << size_) - 1; }

  const std::vector<ToolId>& set_;
  std::size_t size_;
  std::vector<std::vector<double>> least_;        // by first tool: by set and last tool
  std::vector<std::vector<std::size_t>> before_;  // the tool before the last
};

/// What a way costs from the tool that is loaded on.
double cost_along(const std::vector<ToolId>& way, std::optional<ToolId> loaded, const Costs& costs) {
  double sum = 0;
  for (const ToolId tool : way) {
    if (loaded) sum += costs[*loaded][tool];
    loaded = tool;
  }
  return sum;
}

/// Of many tools: always the nearest that is left; then stretches are turned round, or tools put elsewhere, as long as
/// that costs less. Source: G. Croes, "A method for solving traveling-salesman problems", 1958; costs need not be the
/// same both ways, so ways are reckoned anew.
std::vector<ToolId> near_best(std::vector<ToolId> left, const std::optional<ToolId> loaded, const Costs& costs) {
  std::vector<ToolId> out;
  auto at = loaded;
  while (!left.empty()) {
    auto next = left.begin();
    for (auto it = left.begin(); it != left.end(); ++it)
      if (at && costs[*at][*it] < costs[*at][*next]) next = it;
    at = *next;
    out.push_back(*next);
    left.erase(next);
  }
  double cost = cost_along(out, loaded, costs);
  const auto better = [&](std::vector<ToolId> way) {
    const double now = cost_along(way, loaded, costs);
    if (now >= cost - 1e-9) return false;
    out = std::move(way), cost = now;
    return true;
  };
  for (bool found = true; found;) {
    found = false;
    for (std::size_t i = 0; i < out.size(); ++i)
      for (std::size_t j = i + 1; j < out.size(); ++j) {
        const auto from = static_cast<std::ptrdiff_t>(i), to = static_cast<std::ptrdiff_t>(j);
        auto turned = out, moved = out, back = out;
        std::reverse(turned.begin() + from, turned.begin() + to + 1);
        std::rotate(moved.begin() + from, moved.begin() + from + 1, moved.begin() + to + 1);
        std::rotate(back.begin() + from, back.begin() + to, back.begin() + to + 1);
        for (auto* way : {&turned, &moved, &back}) found = better(std::move(*way)) || found;
      }
  }
  return out;
}

/// Of a layer's last tool: what all until then costs at least, with which first tool of the layer, after which last
/// tool of the one before. Of ways that cost the same one whose dearest layer costs least: all of a tower is as wide as
/// what is purged in one layer.
struct Reached {
  double cost = never;
  std::size_t first = 0, before = 0;
  double dearest = 0;  ///< layer

  bool better_than(const Reached& other) const {
    constexpr double same = 1e-6;  // mm³ that sums in another order may differ by
    return cost < other.cost - same || (cost < other.cost + same && dearest < other.dearest - same);
  }
};

/// The ways of each different set.
using PathsOf = std::map<std::vector<int>, Paths>;
std::vector<int> key_of(const std::vector<ToolId>& set) {
  return {set.begin(), set.end()};
}

/// The cheapest chain, from its end to its beginning. @param index of the layers that have tools
ToolSets read_back(const ToolSets& layers, const std::vector<std::size_t>& index,
                   const std::vector<std::vector<Reached>>& reached, const PathsOf& paths, const Costs& costs) {
  ToolSets out(layers.size());
  if (index.empty()) return out;
  std::size_t last = 0;
  for (std::size_t i = 0; i < reached.back().size(); ++i)
    if (reached.back()[i].better_than(reached.back()[last])) last = i;
  for (std::size_t k = index.size(); k-- > 0;) {
    const auto& set = layers[index[k]];
    const auto& at = reached[k][last];
    const auto& own = paths.at(key_of(set));
    if (own.exact())
      out[index[k]] = own.way(at.first, last);
    else
      out[index[k]] = near_best(set, k > 0 ? std::optional(layers[index[k - 1]][at.before]) : std::nullopt, costs);
    last = at.before;
  }
  return out;
}

ToolSets least(const ToolSets& layers, const Costs& costs) {
  PathsOf paths;
  for (const auto& set : layers)
    if (!set.empty()) paths.try_emplace(key_of(set), set, costs);
  std::vector<std::vector<Reached>> reached;
  std::vector<std::size_t> index;  // of the layers that are not empty
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const auto& set = layers[i];
    if (set.empty()) continue;
    const auto& own = paths.at(key_of(set));
    std::vector<Reached> now(set.size());
    if (!own.exact()) {  // from wherever is cheapest, in one order
      const auto* below = index.empty() ? nullptr : &layers[index.back()];
      std::size_t from = 0;
      if (below)
        for (std::size_t b = 0; b < below->size(); ++b)
          if (reached.back()[b].cost < reached.back()[from].cost) from = b;
      const auto way = near_best(set, below ? std::optional((*below)[from]) : std::nullopt, costs);
      const auto last = static_cast<std::size_t>(std::find(set.begin(), set.end(), way.back()) - set.begin());
      now[last] = {below ? reached.back()[from].cost : 0, 0, from, below ? reached.back()[from].dearest : 0};
    } else {
      for (std::size_t first = 0; first < set.size(); ++first)
        for (std::size_t last = 0; last < set.size(); ++last) {
          const double inside = own.cost(first, last);
          if (inside == never) continue;
          if (index.empty()) {
            if (inside < now[last].cost) now[last] = {inside, first, 0, inside};
            continue;
          }
          const auto& below = layers[index.back()];
          for (std::size_t b = 0; b < below.size(); ++b) {
            const auto& until = reached.back()[b];
            const double here = costs[below[b]][set[first]] + inside;
            const Reached way{until.cost + here, first, b, std::max(until.dearest, here)};
            if (way.better_than(now[last])) now[last] = way;
          }
        }
    }
    reached.push_back(std::move(now));
    index.push_back(i);
  }
  return read_back(layers, index, reached, paths, costs);
}

}  // namespace

ToolSets ordered(const ToolSets& layers, const Costs& costs, ToolOrder order) {
  if (order == ToolOrder::least) return least(layers, costs);
  ToolSets out = layers;
  std::optional<ToolId> loaded;
  for (auto& layer : out) {
    std::sort(layer.begin(), layer.end());
    if (order == ToolOrder::cyclic && loaded)
      std::rotate(layer.begin(), std::lower_bound(layer.begin(), layer.end(), *loaded), layer.end());
    if (!layer.empty()) loaded = layer.back();
  }
  return out;
}

double cost_of(const ToolSets& order, const Costs& costs) {
  double sum = 0;
  std::optional<ToolId> loaded;
  for (const auto& layer : order)
    for (const ToolId tool : layer) {
      if (loaded) sum += costs[*loaded][tool];
      loaded = tool;
    }
  return sum;
}

}  // namespace weft::tools
