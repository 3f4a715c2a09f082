// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/block_chain.h"

#include <algorithm>
#include <limits>

namespace weft::travel {
namespace {

/// Blocks of a layer that it may be entered at, and left at.
constexpr std::size_t most_ends = 4;
/// Layers of more blocks are entered where the one below was left.
constexpr std::size_t most_blocks = 24;

/// What a way to another block costs besides its length, as length: a retraction takes about as long as this, µm.
constexpr double other_block_um = 10000;
/// Seams of one part on two layers are nearer than this, µm.
constexpr double same_block_um = 2000;

using Order = std::vector<std::uint32_t>;

/// One way through a layer.
struct Passage {
  Order order;
  double length = 0;     ///< from its first place to its last
  double whole = 0;      ///< of all layers up to here
  std::size_t came = 0;  ///< passage of the layer before
};

Order tour_of(PathOrder kind, const std::vector<Point>& places, const TourEnds& ends) {
  std::vector<Stop> stops;
  for (const Point p : places) stops.push_back({p, p});
  Order order;
  for (const auto& v : tour(kind, stops, ends)) order.push_back(v.stop);
  return order;
}

/// The order of a layer below for places most of which have their own there, the others put in where they lie near the
/// way. Nothing where too many are new.
/// @param below  its places in their order
std::optional<Order> order_like(const std::vector<Point>& below, const std::vector<Point>& places) {
  Order by_x(places.size());
  for (std::uint32_t i = 0; i < by_x.size(); ++i) by_x[i] = i;
  std::sort(by_x.begin(), by_x.end(),
            [&](auto a, auto b) { return std::pair(places[a], a) < std::pair(places[b], b); });
  std::vector<char> taken(places.size(), 0);
  Order out;
  for (const Point p : below) {
    auto i = std::lower_bound(by_x.begin(), by_x.end(), p.x - same_block_um,
                              [&](auto a, double x) { return places[a].x < x; });
    double least = same_block_um;
    std::optional<std::uint32_t> own;
    for (; i != by_x.end() && places[*i].x <= p.x + same_block_um; ++i)
      if (const double d = distance(places[*i], p); taken[*i] == 0 && d < least) least = d, own = *i;
    if (own) taken[*own] = 1, out.push_back(*own);
  }
  if (out.size() * 8 < places.size() * 7) return std::nullopt;
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    if (taken[i] != 0) continue;
    std::size_t best = 0;
    double least = distance(places[i], places[out.front()]);
    for (std::size_t k = 1; k <= out.size(); ++k) {
      const Point before = places[out[k - 1]];
      const double more = k == out.size() ? distance(before, places[i])
                                          : distance(before, places[i]) + distance(places[i], places[out[k]]) -
                                                distance(before, places[out[k]]);
      if (more < least) least = more, best = k;
    }
    out.insert(out.begin() + static_cast<std::ptrdiff_t>(best), i);
  }
  return out;
}

/// The shortest order that begins at one block and, where that is said, ends at another.
Passage passage(PathOrder kind, const std::vector<Point>& places, std::uint32_t first,
                std::optional<std::uint32_t> last) {
  std::vector<Point> between;
  Order index;
  for (std::uint32_t i = 0; i < places.size(); ++i)
    if (i != first && i != last) between.push_back(places[i]), index.push_back(i);
  Passage out;
  out.order.push_back(first);
  for (const auto i : tour_of(kind, between, {places[first], last ? std::optional(places[*last]) : std::nullopt}))
    out.order.push_back(index[i]);
  if (last) out.order.push_back(*last);
  for (std::size_t i = 1; i < out.order.size(); ++i)
    out.length += distance(places[out.order[i - 1]], places[out.order[i]]);
  return out;
}

/// Blocks at which a layer may well begin or end: the ends of its shortest order, and some between.
std::vector<std::uint32_t> ends_of(PathOrder kind, const std::vector<Point>& places) {
  const auto order = tour_of(kind, places, {});
  std::vector<std::uint32_t> ends;
  const std::size_t n = order.size(), count = std::min(most_ends, n);
  for (std::size_t k = 0; k < count; ++k) ends.push_back(order[count > 1 ? k * (n - 1) / (count - 1) : 0]);
  return ends;
}

/// @param exits where the layer below may have ended: what is nearest to them is a beginning too
std::vector<Passage> passages_of(PathOrder kind, const std::vector<Point>& places, const std::vector<Point>& exits) {
  std::vector<Passage> out;
  if (places.size() == 1) return {passage(kind, places, 0, std::nullopt)};
  const auto ends = ends_of(kind, places);
  std::vector<std::uint32_t> near;
  for (const Point q : exits) {
    const auto nearest = std::min_element(places.begin(), places.end(),
                                          [&](Point a, Point b) { return distance2(a, q) < distance2(b, q); });
    const auto i = static_cast<std::uint32_t>(nearest - places.begin());
    if (std::find(ends.begin(), ends.end(), i) == ends.end() && std::find(near.begin(), near.end(), i) == near.end())
      near.push_back(i);
  }
  for (const auto first : near) out.push_back(passage(kind, places, first, std::nullopt));
  for (const auto first : ends) {
    out.push_back(passage(kind, places, first, std::nullopt));
    for (const auto last : ends)
      if (last != first && last != out.back().order.back()) out.push_back(passage(kind, places, first, last));
  }
  return out;
}

}  // namespace

Order shortened(const std::vector<Point>& places, const Order& order, const TourEnds& ends) {
  std::vector<Stop> stops;
  std::vector<Visit> visits;
  for (const Point p : places) stops.push_back({p, p});
  for (const auto i : order) visits.push_back({i, false});
  Order out;
  for (const auto& v : shortened(stops, visits, ends)) out.push_back(v.stop);
  return out;
}

/// Of one layer; none where it has no blocks.
struct BlockChain::Passages {
  std::vector<Passage> all;
};

BlockChain::BlockChain(PathOrder order) : kind_(order) {}
BlockChain::~BlockChain() = default;

void BlockChain::add(BlockPlaces layer) {
  auto& here = layers_.emplace_back().all;
  if (layer.places.empty()) return;
  if (kind_ == PathOrder::nearest || layer.small || layer.places.size() > most_blocks) {
    // From where the best way so far ends.
    const auto best = static_cast<std::size_t>(std::min_element(costs_.begin(), costs_.end()) - costs_.begin());
    const auto from = layer.before ? layer.before : exits_.empty() ? std::nullopt : std::optional(exits_[best]);
    Passage only;
    only.order =
        layer.small ? one_way(layer.places, {from, std::nullopt}) : tour_of(kind_, layer.places, {from, std::nullopt});
    here.push_back(std::move(only));
  } else {
    here = passages_of(kind_, layer.places, exits_);
  }
  for (auto& p : here) {
    const Point entry = layer.places[p.order.front()];
    p.whole = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < costs_.size(); ++k) {
      double way = 0;
      if (layer.before)
        way = (exits_.empty() ? 0.0 : distance(exits_[k], *layer.before)) + distance(*layer.before, entry);
      else if (!exits_.empty())
        way = distance(exits_[k], entry);
      if (way > same_block_um) way += other_block_um;
      if (costs_[k] + way + p.length < p.whole) p.whole = costs_[k] + way + p.length, p.came = k;
    }
  }
  exits_.clear(), costs_.clear();
  for (const auto& p : here) exits_.push_back(layer.places[p.order.back()]), costs_.push_back(p.whole);
}

/// Local moves from the order below find what a search from nothing does, but for what adds up over many layers.
Order BlockChain::one_way(const std::vector<Point>& places, const TourEnds& ends) {
  constexpr int most_alike = 8;
  constexpr std::size_t last = 2;  // layers of support alone lie between those that the part has too
  std::optional<Order> order;
  if (kind_ == PathOrder::optimized && like_below_ < most_alike)
    for (auto below = below_.rbegin(); below != below_.rend() && !order; ++below) order = order_like(*below, places);
  like_below_ = order ? like_below_ + 1 : 0;
  order = order ? shortened(places, *order, ends) : tour_of(kind_, places, ends);
  if (below_.size() == last) below_.erase(below_.begin());
  auto& own = below_.emplace_back();
  for (const auto i : *order) own.push_back(places[i]);
  return *order;
}

std::vector<std::vector<std::uint32_t>> BlockChain::orders() {
  std::vector<std::vector<std::uint32_t>> orders(layers_.size());
  auto at = static_cast<std::size_t>(std::min_element(costs_.begin(), costs_.end()) - costs_.begin());
  for (std::size_t i = layers_.size(); i-- > 0;) {
    if (layers_[i].all.empty()) continue;
    auto& chosen = layers_[i].all[at];
    orders[i] = std::move(chosen.order);
    at = chosen.came;
  }
  layers_.clear(), exits_.clear(), costs_ = {0}, below_.clear(), like_below_ = 0;
  return orders;
}

}  // namespace weft::travel
