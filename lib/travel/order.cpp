// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "geometry/spatial_index.h"
#include "travel/open_walls.h"
#include "travel/tour.h"
#include "travel/wall_order.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace weft::travel {
namespace {

/// Puts the beads of one block in order, as turns behind those of the blocks before.
class BlockOrder {
 public:
  BlockOrder(const TravelSettings& settings, const Prepared& layer, const Linked& linked, std::uint32_t block,
             std::vector<Turn>& turns)
      : settings_(settings),
        layer_(layer),
        linked_(linked),
        index_(block),
        block_(layer.blocks[block]),
        beads_(beads_of(layer.input, block_)),
        turns_(turns) {}

  /// @param at where the nozzle is; @returns where it is afterwards
  std::optional<Point> run(std::optional<Point> at, std::optional<Point> then) {
    if (block_.object == Block::adhesion) return in_list_order(block_.fills, at);
    const std::size_t first = turns_.size();
    const auto from = at;
    const bool fills_first = settings_.infill_before_walls && !block_.walls.empty();
    std::vector<std::uint32_t> first_fills, last_fills = block_.fills;
    if (fills_first)
      first_fills.swap(last_fills);
    else
      find_bridges_under_walls(first_fills, last_fills);
    const auto ironing =
        taken(first_fills, last_fills, [this](std::uint32_t b) { return beads_[b].role == Role::ironing; });
    const auto rungs = taken(first_fills, last_fills, [this](std::uint32_t b) { return is_rung(beads_[b]); });
    if (!first_fills.empty()) at = fills(first_fills, at, linked_.places[index_]);
    const bool walls_last = last_fills.empty() && rungs.empty() && ironing.empty();
    const auto walls = order_walls(settings_, layer_, linked_, index_, at, walls_last ? then : std::nullopt);
    for (const auto& turn : walls) at = append(turn);
    if (!last_fills.empty()) at = fills(last_fills, at, then);
    if (!rungs.empty()) at = fills(rungs, at, then);
    if (!ironing.empty()) at = fills(ironing, at, then);
    if (settings_.path_order == PathOrder::nearest) return at;
    fit_open_walls(beads_, std::span(turns_).subspan(first), {from, then});
    return turns_.size() > first ? std::optional(end_of(beads_[turns_.back().bead], turns_.back())) : at;
  }

 private:
  Turn turn(std::uint32_t bead, Start start, bool reversed) const { return {index_, bead, start, reversed}; }

  std::optional<Point> append(const Turn& turn) {
    turns_.push_back(turn);
    return end_of(beads_[turn.bead], turn);
  }

  /// Over nothing, from one bead of support to another of its layer: these come first, or its ends hold on to nothing.
  static bool is_rung(const Bead& bead) { return bead.role == Role::support && bead.sequence != 0; }

  /// What has its time after all else that a part holds: ironing goes over it, rungs end on it.
  template <class Is>
  static std::vector<std::uint32_t> taken(std::vector<std::uint32_t>& first, std::vector<std::uint32_t>& last, Is is) {
    std::vector<std::uint32_t> out;
    for (auto* fills : {&first, &last}) {
      std::copy_if(fills->begin(), fills->end(), std::back_inserter(out), is);
      std::erase_if(*fills, is);
    }
    return out;
  }

  std::optional<Point> in_list_order(const std::vector<std::uint32_t>& beads, std::optional<Point> at) {
    for (const std::uint32_t b : beads) at = append(nearest_turn(beads_, index_, b, at));
    return at;
  }

  /// Beads of one sequence: in their order, each entered at the end that makes the whole shortest.
  std::vector<Turn> chain(const std::vector<std::uint32_t>& beads) const {
    std::vector<std::array<double, 2>> cost(beads.size());
    std::vector<std::array<char, 2>> came(beads.size());
    const auto ends = [&](std::size_t i, int reversed) {
      const Turn t = turn(beads[i], {0, beads_[beads[i]].path[0].at}, reversed != 0);
      return std::pair{begin_of(beads_[beads[i]], t), end_of(beads_[beads[i]], t)};
    };
    cost[0] = {0, 0};
    for (std::size_t i = 1; i < beads.size(); ++i)
      for (int r = 0; r < 2; ++r) {
        const Point entry = ends(i, r).first;
        const double from0 = cost[i - 1][0] + distance(ends(i - 1, 0).second, entry);
        const double from1 = cost[i - 1][1] + distance(ends(i - 1, 1).second, entry);
        cost[i][static_cast<std::size_t>(r)] = std::min(from0, from1);
        came[i][static_cast<std::size_t>(r)] = from1 < from0 ? 1 : 0;
      }
    std::vector<Turn> turns(beads.size());
    std::size_t r = cost.back()[1] < cost.back()[0] ? 1 : 0;
    for (std::size_t i = beads.size(); i-- > 0;) {
      turns[i] = turn(beads[i], {0, beads_[beads[i]].path[0].at}, r != 0);
      if (i > 0) r = static_cast<std::size_t>(came[i][r]);
    }
    return turns;
  }

  /// Lines side by side are printed in their order where it shows: on top, from below, and over air, where each leans
  /// on the one before. Inside a part, and for a strip's only line, the shortest way is the better order.
  bool in_sequence(const Bead& bead) const {
    if (bead.sequence == 0) return false;
    return bead.role == Role::top_skin || bead.role == Role::bridge || bead.role == Role::ironing ||
           (layer_.input.time.first() && bead.role != Role::gap_fill);
  }

  /// Walls over the gap that a bridge spans hang on nothing but each other: the bridge is laid before them, so that
  /// they lie against it. One over sparse infill has its time after them.
  void find_bridges_under_walls(std::vector<std::uint32_t>& bridges, std::vector<std::uint32_t>& others) const {
    const auto is_bridge = [&](std::uint32_t b) { return beads_[b].role == Role::bridge; };
    if (block_.object == Block::adhesion || block_.walls.empty() ||
        std::none_of(others.begin(), others.end(), is_bridge))
      return;
    const Regions& over_air = layer_.input.objects[block_.object].over_air;
    if (over_air.empty()) return;
    constexpr double least_um = 1000;  // of what hangs: shorter walls carry themselves
    const geometry::SegmentIndex air(over_air);
    const auto hangs = [&](std::uint32_t b) {
      const auto& path = beads_[b].path;
      for (std::size_t i = beads_[b].closed ? 0 : 1, j = i == 0 ? path.size() - 1 : 0; i < path.size(); j = i++) {
        const double length = distance(path[j].at, path[i].at);
        for (double along = least_um / 2; along + least_um / 2 <= length; along += least_um / 2)
          if (air.region_at(lerp(path[j].at, path[i].at, along / length))) return true;
      }
      return false;
    };
    if (std::none_of(block_.walls.begin(), block_.walls.end(), hangs)) return;
    const auto rest = std::stable_partition(others.begin(), others.end(),
                                            [&](std::uint32_t b) { return !is_bridge(b) || !hangs(b); });
    bridges.assign(rest, others.end());
    others.erase(rest, others.end());
  }

  std::optional<Point> fills(const std::vector<std::uint32_t>& which, std::optional<Point> at,
                             std::optional<Point> then) {
    std::vector<Stop> stops;
    std::vector<std::vector<Turn>> chains;  // of stops that are a sequence
    std::vector<std::uint32_t> bead_of;     // of the others
    constexpr std::uint32_t is_chain = 0x80000000;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> sequenced;
    for (const std::uint32_t b : which) {
      const Bead& bead = beads_[b];
      if (in_sequence(bead)) {
        sequenced.push_back({bead.sequence, b});
      } else {
        const Turn t = nearest_turn(beads_, index_, b, bead.closed ? at : std::nullopt);
        stops.push_back({begin_of(bead, t), end_of(bead, t)});
        bead_of.push_back(b);
      }
    }
    std::stable_sort(sequenced.begin(), sequenced.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < sequenced.size();) {
      std::vector<std::uint32_t> beads;
      const std::uint32_t sequence = sequenced[i].first;
      for (; i < sequenced.size() && sequenced[i].first == sequence; ++i) beads.push_back(sequenced[i].second);
      chains.push_back(chain(beads));
      const auto& turns = chains.back();
      const bool seen = beads_[turns.front().bead].role == Role::top_skin;  // lines that shine alike run one way
      stops.push_back({begin_of(beads_[turns.front().bead], turns.front()),
                       end_of(beads_[turns.back().bead], turns.back()), !seen});
      bead_of.push_back(is_chain | static_cast<std::uint32_t>(chains.size() - 1));
    }
    for (const auto& visit : tour(settings_.path_order, stops, {at, then})) {
      const std::uint32_t b = bead_of[visit.stop];
      if (b & is_chain) {
        auto& turns = chains[b & ~is_chain];
        if (visit.reversed) {
          std::reverse(turns.begin(), turns.end());
          for (auto& t : turns) t.reversed = !t.reversed;
        }
        for (const auto& t : turns) at = append(t);
      } else if (beads_[b].closed) {
        at = append(nearest_turn(beads_, index_, b, at));
      } else {
        at = append(turn(b, {}, visit.reversed));
      }
    }
    return at;
  }

  const TravelSettings& settings_;
  const Prepared& layer_;
  const Linked& linked_;
  std::uint32_t index_;
  const Block& block_;
  const Beads& beads_;
  std::vector<Turn>& turns_;
};

}  // namespace

Ordered order(const TravelSettings& settings, const Prepared& layer, const Linked& linked) {
  Ordered out;
  std::optional<Point> at = linked.from;
  for (std::size_t b = 0; b < linked.block_order.size(); ++b) {
    stop_if_asked();
    const bool last = b + 1 == linked.block_order.size();
    const auto then = last ? linked.next : std::optional(linked.places[linked.block_order[b + 1]]);
    at = BlockOrder(settings, layer, linked, linked.block_order[b], out.turns).run(at, then);
  }
  if (out.turns.empty()) return out;
  const auto bead = [&](const Turn& t) -> const Bead& { return beads_of(layer.input, layer.blocks[t.block])[t.bead]; };
  out.begin = begin_of(bead(out.turns.front()), out.turns.front());
  out.end = end_of(bead(out.turns.back()), out.turns.back());
  return out;
}

TourGap gap_of(const Prepared& layer, const Ordered& ordered, std::optional<Point> from) {
  std::vector<Stop> stops;
  std::vector<Visit> visits;
  for (const Turn& turn : ordered.turns) {
    const Bead& bead = beads_of(layer.input, layer.blocks[turn.block])[turn.bead];
    visits.push_back({static_cast<std::uint32_t>(stops.size()), false});
    stops.push_back({begin_of(bead, turn), end_of(bead, turn)});
  }
  return {way(stops, visits, {from, {}}), least_way(stops, {from, {}})};
}

}  // namespace weft::travel
