#include "travel/blocks.h"
#include "travel/tour.h"

#include <algorithm>
#include <array>
#include <limits>

namespace weft::travel {
namespace {

constexpr Um snap_um = 100;

Point begin_of(const Bead& bead, const Turn& turn) {
  if (bead.closed) return turn.start.at;
  return turn.reversed ? bead.path.back().at : bead.path.front().at;
}
Point end_of(const Bead& bead, const Turn& turn) {
  if (bead.closed) return turn.start.at;
  return turn.reversed ? bead.path.front().at : bead.path.back().at;
}

/// Puts the beads of one block in order, as turns behind those of the blocks before.
class BlockOrder {
 public:
  BlockOrder(const TravelSettings& settings, const Prepared& layer, const Linked& linked, std::uint32_t block,
             std::vector<Turn>& turns)
      : settings_(settings),
        linked_(linked),
        index_(block),
        block_(layer.blocks[block]),
        beads_(beads_of(layer.input, block_)),
        turns_(turns) {}

  /// @param at where the nozzle is; @returns where it is afterwards
  std::optional<Point> run(std::optional<Point> at, std::optional<Point> then) {
    if (block_.object == Block::adhesion) return in_list_order(block_.fills, at);
    return fills(walls(at), then);
  }

 private:
  Turn turn(std::uint32_t bead, Start start, bool reversed) const { return {index_, bead, start, reversed}; }

  std::optional<Point> append(const Turn& turn) {
    turns_.push_back(turn);
    return end_of(beads_[turn.bead], turn);
  }

  /// A bead from wherever it is nearest.
  Turn nearest_turn(std::uint32_t bead, std::optional<Point> at) const {
    const Bead& b = beads_[bead];
    if (b.closed) return turn(bead, at ? nearest_start(b, *at, snap_um) : Start{0, b.path[0].at}, false);
    return turn(bead, {}, at && distance2(*at, b.path.back().at) < distance2(*at, b.path.front().at));
  }

  std::optional<Point> in_list_order(const std::vector<std::uint32_t>& beads, std::optional<Point> at) {
    for (const std::uint32_t b : beads) at = append(nearest_turn(b, at));
    return at;
  }

  /// Where an inner wall begins whose neighbour begins there.
  Start beside(const Bead& bead, const Start& neighbour) const {
    const Start start = nearest_start(bead, neighbour.at, snap_um);
    if (!settings_.staggered_inner_seams || bead.inset % 2 == 0) return start;
    double left = 3.0 * bead.path[start.segment].width;  // along the bead
    const std::size_t n = bead.path.size();
    Point at = start.at;
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = (start.segment + k) % n, next = (i + 1) % n;
      const double step = distance(at, bead.path[next].at);
      if (step > left) return {static_cast<std::uint32_t>(i), lerp(at, bead.path[next].at, left / step)};
      left -= step;
      at = bead.path[next].at;
    }
    return start;
  }

  /// Inner walls begin beside the seam of the outer wall they follow, so that the way from one to the next is a line's
  /// width.
  void choose_starts(const std::vector<Touch>& touches) {
    const std::size_t n = block_.walls.size();
    starts_.assign(n, {});
    chosen_.assign(n, 0);
    std::vector<std::uint32_t> known;
    for (std::uint32_t w = 0; w < n; ++w)
      if (block_.seams[w] != Block::no_seam)
        starts_[w] = linked_.seams[block_.seams[w]], chosen_[w] = 1, known.push_back(w);
    for (std::size_t k = 0; k < known.size(); ++k)  // outwards from the seams
      for (const auto& t : touches) {
        if (t.first != known[k] && t.second != known[k]) continue;
        const std::uint32_t other = t.first == known[k] ? t.second : t.first;
        if (chosen_[other] || !beads_[block_.walls[other]].closed) continue;
        starts_[other] = beside(beads_[block_.walls[other]], starts_[known[k]]);
        chosen_[other] = 1;
        known.push_back(other);
      }
  }

  Turn wall_turn(std::uint32_t w, std::optional<Point> at) const {
    if (chosen_[w] && settings_.z_seam_type != SeamType::shortest) return turn(block_.walls[w], starts_[w], false);
    return nearest_turn(block_.walls[w], at);
  }

  /// The nearest wall whose predecessors are done, again and again.
  std::optional<Point> walls(std::optional<Point> at) {
    const std::size_t n = block_.walls.size();
    if (n == 0) return at;
    const auto touches = touching_walls(beads_, block_.walls);
    choose_starts(touches);
    std::vector<std::uint32_t> waiting(n, 0), ready;
    for (const auto& t : touches) ++waiting[t.second];
    for (std::uint32_t w = 0; w < n; ++w)
      if (waiting[w] == 0) ready.push_back(w);
    while (!ready.empty()) {
      std::size_t best = 0;
      Turn best_turn = wall_turn(ready[0], at);
      if (at) {
        std::int64_t best2 = distance2(*at, begin_of(beads_[best_turn.bead], best_turn));
        for (std::size_t k = 1; k < ready.size(); ++k) {
          const Turn t = wall_turn(ready[k], at);
          const std::int64_t d2 = distance2(*at, begin_of(beads_[t.bead], t));
          if (d2 < best2 || (d2 == best2 && ready[k] < ready[best])) best = k, best2 = d2, best_turn = t;
        }
      }
      const std::uint32_t done = ready[best];
      ready.erase(ready.begin() + static_cast<std::ptrdiff_t>(best));
      at = append(best_turn);
      const auto from = std::lower_bound(touches.begin(), touches.end(), done,
                                         [](const Touch& t, std::uint32_t w) { return t.first < w; });
      for (auto t = from; t != touches.end() && t->first == done; ++t)
        if (--waiting[t->second] == 0) ready.push_back(t->second);
    }
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

  std::optional<Point> fills(std::optional<Point> at, std::optional<Point> then) {
    std::vector<Stop> stops;
    std::vector<std::vector<Turn>> chains;  // of stops that are a sequence
    std::vector<std::uint32_t> bead_of;     // of the others
    constexpr std::uint32_t is_chain = 0x80000000;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> sequenced;
    for (const std::uint32_t b : block_.fills) {
      const Bead& bead = beads_[b];
      if (bead.sequence != 0) {
        sequenced.push_back({bead.sequence, b});
      } else {
        const Turn t = nearest_turn(b, bead.closed ? at : std::nullopt);
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
      stops.push_back({begin_of(beads_[turns.front().bead], turns.front()),
                       end_of(beads_[turns.back().bead], turns.back()), false});
      bead_of.push_back(is_chain | static_cast<std::uint32_t>(chains.size() - 1));
    }
    for (const auto& visit : tour(settings_.path_order, stops, {at, then})) {
      const std::uint32_t b = bead_of[visit.stop];
      if (b & is_chain) {
        for (const auto& t : chains[b & ~is_chain]) at = append(t);
      } else if (beads_[b].closed) {
        at = append(nearest_turn(b, at));
      } else {
        at = append(turn(b, {}, visit.reversed));
      }
    }
    return at;
  }

  const TravelSettings& settings_;
  const Linked& linked_;
  std::uint32_t index_;
  const Block& block_;
  const Beads& beads_;
  std::vector<Turn>& turns_;
  std::vector<Start> starts_;
  std::vector<char> chosen_;
};

}  // namespace

Ordered order(const TravelSettings& settings, const Prepared& layer, const Linked& linked) {
  Ordered out;
  std::optional<Point> at = linked.from;
  for (std::size_t b = 0; b < linked.block_order.size(); ++b) {
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

}  // namespace weft::travel
