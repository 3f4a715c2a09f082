// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/touching.h"

#include "core/disjoint_sets.h"
#include "geometry/boolean.h"
#include "geometry/spatial_index.h"

#include <algorithm>
#include <iterator>
#include <map>
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

/// f(regions of a set) for all sets; what it returns, together.
template <class F>
Regions by_sets(const Regions& regions, const std::vector<std::vector<std::size_t>>& sets, F f) {
  Regions out;
  for (const auto& set : sets) {
    Regions some;
    for (const std::size_t i : set) some.push_back(regions[i]);
    some = f(std::move(some));
    std::move(some.begin(), some.end(), std::back_inserter(out));
  }
  return out;
}

/// By sets of those whose boxes, larger by so much, meet.
template <class F>
Regions by_clusters(const Regions& regions, Um larger, F f) {
  std::vector<Box> boxes;
  boxes.reserve(regions.size());
  for (const Region& region : regions) boxes.push_back(box_of(region.outer).grown(larger));
  return by_sets(regions, touching(boxes), f);
}

/// Which regions overlap or touch, directly or by others.
class Overlapping {
 public:
  explicit Overlapping(const Regions& regions)
      : rings_(rings_of(regions)), index_(rings_), count_(regions.size()), together_(count_) {
    for (std::uint32_t r = 0; r < regions.size(); ++r) of_ring_.insert(of_ring_.end(), 1 + regions[r].holes.size(), r);
    join_outlines();
    join_what_lies_within(regions);
  }
  std::vector<std::vector<std::size_t>> sets() {
    std::vector<std::vector<std::size_t>> by_least(count_), out;
    for (std::size_t i = 0; i < count_; ++i) by_least[together_.of(i)].push_back(i);
    for (auto& set : by_least)
      if (!set.empty()) out.push_back(std::move(set));
    return out;
  }

 private:
  void join_outlines() {
    for (const auto& [a, b] : index_.rings_that_meet()) together_.join(of_ring_[a], of_ring_[b]);
  }
  /// What no outline crosses lies in another as its first corner does.
  void join_what_lies_within(const Regions& regions) {
    std::vector<SegmentIndex::RingWinding> windings;
    for (std::size_t r = 0; r < regions.size(); ++r) {
      index_.windings(regions[r].outer.front(), windings);
      std::map<std::size_t, int> around;
      for (const auto& w : windings) around[of_ring_[w.ring]] += w.winding;
      for (const auto& [other, winding] : around)
        if (other != r && winding != 0) together_.join(r, other);
    }
  }

  std::vector<Ring> rings_;
  SegmentIndex index_;
  std::vector<std::size_t> of_ring_;  // its region
  std::size_t count_;
  DisjointSets together_;
};

}  // namespace

std::vector<std::vector<std::size_t>> overlapping(const Regions& regions) {
  std::vector<Box> boxes;
  boxes.reserve(regions.size());
  for (const Region& region : regions) boxes.push_back(box_of(region.outer));
  const auto near = touching(boxes);
  if (near.size() == 1) return Overlapping(regions).sets();
  // Each cluster of boxes by itself: what lies far away makes no question longer.
  std::vector<std::vector<std::size_t>> out;
  for (const auto& cluster : near) {
    if (cluster.size() == 1) {
      out.push_back(cluster);
      continue;
    }
    Regions some;
    some.reserve(cluster.size());
    for (const std::size_t i : cluster) some.push_back(regions[i]);
    for (auto& set : Overlapping(some).sets()) {
      for (std::size_t& i : set) i = cluster[i];
      out.push_back(std::move(set));
    }
  }
  std::sort(out.begin(), out.end());  // by their least
  return out;
}

namespace {

/// So few are done at once sooner than it is known which of them overlap.
bool are_few(const Regions& regions) {
  constexpr std::size_t few = 64;
  return regions.size() <= few;
}

/// Boxes of what is long or bent meet much that it does not: what overlaps is told by outlines.
Regions joined_where_met(const Regions& regions) {
  if (regions.size() < 2) return regions;
  if (are_few(regions)) return unite(regions);
  return by_sets(regions, overlapping(regions), [](Regions some) { return some.size() > 1 ? unite(some) : some; });
}

}  // namespace

Regions joined(const Regions& regions) {
  return by_clusters(regions, 1, [](const Regions& some) { return joined_where_met(some); });
}

Regions offset_apart(const Regions& regions, const OffsetOptions& options) {
  // Corners may reach as far as the miter limit lets them.
  const Um larger = rounded(std::max(options.by, 0) * std::max(options.miter_limit, 1.0)) + 2;
  return by_clusters(regions, larger, [&](const Regions& some) {
    if (are_few(some)) return offset(some, options);
    Regions each;
    for (const Region& region : some) {
      Regions one = offset({region}, options);
      std::move(one.begin(), one.end(), std::back_inserter(each));
    }
    return joined_where_met(each);
  });
}

}  // namespace weft::geometry
