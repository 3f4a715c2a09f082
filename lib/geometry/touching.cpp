// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/touching.h"

#include "core/disjoint_sets.h"
#include "geometry/boolean.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace weft::geometry {

std::vector<std::vector<std::size_t>> touching(std::span<const Box> boxes) {
  std::vector<std::size_t> order(boxes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return std::pair(boxes[a].min.x, a) < std::pair(boxes[b].min.x, b); });
  DisjointSets together(boxes.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && boxes[order[j]].min.x <= boxes[order[i]].max.x; ++j)
      if (boxes[order[i]].overlaps(boxes[order[j]])) together.join(order[i], order[j]);
  std::vector<std::vector<std::size_t>> by_least(boxes.size()), out;
  for (std::size_t i = 0; i < boxes.size(); ++i) by_least[together.of(i)].push_back(i);
  for (auto& set : by_least)
    if (!set.empty()) out.push_back(std::move(set));
  return out;
}

namespace {

/// f(regions of a cluster) for all of them, their boxes larger by so much; what it returns, together.
template <class F>
Regions by_clusters(const Regions& regions, Um larger, F f) {
  std::vector<Box> boxes;
  boxes.reserve(regions.size());
  for (const Region& region : regions) boxes.push_back(box_of(region.outer).grown(larger));
  Regions out;
  for (const auto& set : touching(boxes)) {
    Regions some;
    for (const std::size_t i : set) some.push_back(regions[i]);
    some = f(std::move(some));
    std::move(some.begin(), some.end(), std::back_inserter(out));
  }
  return out;
}

}  // namespace

Regions joined(const Regions& regions) {
  return by_clusters(regions, 1, [](Regions some) { return some.size() > 1 ? unite(some) : some; });
}

Regions offset_apart(const Regions& regions, const OffsetOptions& options) {
  // Corners may reach as far as the miter limit lets them.
  const Um larger = rounded(std::max(options.by, 0) * std::max(options.miter_limit, 1.0)) + 2;
  return by_clusters(regions, larger, [&](const Regions& some) { return offset(some, options); });
}

}  // namespace weft::geometry
