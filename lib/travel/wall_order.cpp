// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/wall_order.h"

#include "core/stop.h"
#include "travel/box_tree.h"

#include <algorithm>
#include <limits>
#include <span>

namespace weft::travel {
namespace {

/// A start this near to a junction is moved to it, µm.
constexpr Um snap_um = 100;
/// A hop longer than this ends a run of walls that belong together, µm.
constexpr double run_hop_um = 1500;
/// More seams than this are not tried for one inner wall.
constexpr std::size_t most_starts = 4;
/// More runs than this are left in the greedy order.
constexpr std::size_t most_runs = 24;

/// Who touches each wall, in the order of the touches.
class Neighbours {
 public:
  Neighbours(std::span<const Touch> touches, std::uint32_t walls) : begins_(walls + 1, 0), others_(2 * touches.size()) {
    for (const auto& t : touches) ++begins_[t.first], ++begins_[t.second];
    std::uint32_t sum = 0;
    for (auto& begin : begins_) begin = sum += begin;  // ends, which filling from behind turns into begins
    for (std::size_t i = touches.size(); i-- > 0;) {
      others_[--begins_[touches[i].first]] = touches[i].second;
      others_[--begins_[touches[i].second]] = touches[i].first;
    }
  }
  std::span<const std::uint32_t> of(std::uint32_t wall) const {
    return {others_.data() + begins_[wall], begins_[wall + 1] - begins_[wall]};
  }

 private:
  std::vector<std::uint32_t> begins_, others_;
};

class WallOrder {
 public:
  WallOrder(const TravelSettings& settings, const Prepared& layer, const Linked& linked, std::uint32_t block)
      : settings_(settings),
        linked_(linked),
        index_(block),
        block_(layer.blocks[block]),
        beads_(beads_of(layer.input, block_)),
        touches_(touching_walls(beads_, block_.walls)) {
    choose_starts();
  }

  std::vector<Turn> run(std::optional<Point> from, std::optional<Point> to) {
    from_ = from, to_ = to;
    auto sequence = greedy();
    if (settings_.path_order == PathOrder::optimized) improve(sequence);
    return turns_of(sequence);
  }

 private:
  using Sequence = std::vector<std::uint32_t>;
  const Bead& bead(std::uint32_t w) const { return beads_[block_.walls[w]]; }
  Turn turn(std::uint32_t w, Start start, bool reversed) const { return {index_, block_.walls[w], start, reversed}; }

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

  void choose_starts() {
    const auto n = static_cast<std::uint32_t>(block_.walls.size());
    starts_.resize(n);
    if (settings_.z_seam_type == SeamType::shortest) return;
    for (std::uint32_t w = 0; w < n; ++w)
      if (block_.seams[w] != Block::no_seam) starts_[w].push_back(linked_.seams[block_.seams[w]]);
    const Neighbours neighbours(touches_, n);
    std::vector<std::pair<std::uint32_t, Start>> spread;
    std::vector<std::uint32_t> reached_from(n, Block::no_seam);
    for (std::uint32_t w = 0; w < n; ++w) {
      stop_if_asked();
      if (block_.seams[w] == Block::no_seam) continue;
      // From the outer wall inwards, wall by wall.
      spread.assign(1, {w, starts_[w][0]});
      for (std::size_t k = 0; k < spread.size(); ++k) {
        const auto [wall, start] = spread[k];
        for (const std::uint32_t other : neighbours.of(wall)) {
          if (reached_from[other] == w || bead(other).inset <= bead(wall).inset || !bead(other).closed) continue;
          reached_from[other] = w;
          if (starts_[other].size() < most_starts)
            starts_[other].push_back(beside(bead(other), settings_.staggered_inner_seams ? starts_[w][0] : start));
          spread.push_back({other, starts_[other].back()});
        }
      }
    }
  }

  Turn nearest(std::uint32_t w, std::optional<Point> at) const {
    const auto& starts = starts_[w];
    if (starts.empty()) return nearest_turn(beads_, index_, block_.walls[w], at);
    const Start* best = &starts[0];
    if (at)
      for (const auto& s : starts)
        if (distance2(*at, s.at) < distance2(*at, best->at)) best = &s;
    return turn(w, *best, false);
  }

  /// The nearest wall whose predecessors are done, again and again.
  Sequence greedy() const {
    const auto n = static_cast<std::uint32_t>(block_.walls.size());
    Sequence sequence;
    std::vector<std::uint32_t> waiting(n, 0);
    for (const auto& t : touches_) ++waiting[t.second];
    std::vector<Box> boxes(n);
    for (std::uint32_t w = 0; w < n; ++w) boxes[w] = box_of(bead(w));
    BoxTree ready(boxes);
    for (std::uint32_t w = 0; w < n; ++w)
      if (waiting[w] == 0) ready.set(w, boxes[w]);
    std::optional<Point> at = from_;
    while (sequence.size() < n) {
      stop_if_asked();
      std::uint32_t done = n;
      Turn done_turn;
      std::int64_t nearest2 = std::numeric_limits<std::int64_t>::max();
      ready.search(
          static_cast<double>(nearest2), [&](const Box& box, double) { return at ? distance2_to(box, *at) : 0.0; },
          [&](std::uint32_t w) {
            const Turn t = nearest(w, at);
            const std::int64_t d2 = at ? distance2(*at, begin_of(bead(w), t)) : 0;
            if (d2 < nearest2 || (d2 == nearest2 && w < done)) done = w, nearest2 = d2, done_turn = t;
            return static_cast<double>(nearest2);
          });
      ready.set(done, {});
      sequence.push_back(done);
      at = end_of(bead(done), done_turn);
      const auto first = std::lower_bound(touches_.begin(), touches_.end(), done,
                                          [](const Touch& t, std::uint32_t w) { return t.first < w; });
      for (auto t = first; t != touches_.end() && t->first == done; ++t)
        if (--waiting[t->second] == 0) ready.set(t->second, boxes[t->second]);
    }
    return sequence;
  }

  /// Turns and way of a sequence, each wall begun where it is nearest.
  double way(const Sequence& sequence, std::vector<Turn>* turns) const {
    double sum = 0;
    std::optional<Point> at = from_;
    for (const std::uint32_t w : sequence) {
      const Turn t = nearest(w, at);
      if (at) sum += distance(*at, begin_of(bead(w), t));
      at = end_of(bead(w), t);
      if (turns) turns->push_back(t);
    }
    if (at && to_) sum += distance(*at, *to_);
    return sum;
  }

  std::vector<Turn> turns_of(const Sequence& sequence) const {
    std::vector<Turn> turns;
    turns.reserve(sequence.size());
    way(sequence, &turns);
    return turns;
  }

  bool allowed(const Sequence& sequence) const {
    std::vector<std::uint32_t> position(sequence.size());
    for (std::uint32_t i = 0; i < sequence.size(); ++i) position[sequence[i]] = i;
    return std::all_of(touches_.begin(), touches_.end(),
                       [&](const Touch& t) { return position[t.first] < position[t.second]; });
  }

  /// First positions of the runs of a sequence, and its end.
  std::vector<std::size_t> runs_of(const Sequence& sequence) const {
    std::vector<std::size_t> runs;
    const auto turns = turns_of(sequence);
    for (std::size_t i = 0; i < turns.size(); ++i)
      if (i == 0 || distance(end_of(beads_[turns[i - 1].bead], turns[i - 1]),
                             begin_of(beads_[turns[i].bead], turns[i])) > run_hop_um)
        runs.push_back(i);
    runs.push_back(sequence.size());
    return runs;
  }

  void improve(Sequence& sequence) const {
    double best = way(sequence, nullptr);
    for (int pass = 0; pass < 4; ++pass) {
      const auto runs = runs_of(sequence);
      const std::size_t n = runs.size() - 1;
      if (n < 2 || n > most_runs) return;
      // Swapping two neighbouring groups of runs is moving one of them.
      Sequence found;
      for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = a + 1; b < n; ++b)
          for (std::size_t c = b + 1; c <= n && c <= b + 3; ++c) {
            stop_if_asked();
            Sequence next = sequence;
            std::rotate(next.begin() + static_cast<std::ptrdiff_t>(runs[a]),
                        next.begin() + static_cast<std::ptrdiff_t>(runs[b]),
                        next.begin() + static_cast<std::ptrdiff_t>(runs[c]));
            const double length = way(next, nullptr);
            if (length < best - 1 && allowed(next)) best = length, found = std::move(next);
          }
      if (found.empty()) return;
      sequence = std::move(found);
    }
  }

  const TravelSettings& settings_;
  const Linked& linked_;
  std::uint32_t index_;
  const Block& block_;
  const Beads& beads_;
  std::vector<Touch> touches_;
  std::vector<std::vector<Start>> starts_;
  std::optional<Point> from_, to_;
};

}  // namespace

Point begin_of(const Bead& bead, const Turn& turn) {
  if (bead.closed) return turn.start.at;
  return turn.reversed ? bead.path.back().at : bead.path.front().at;
}

Point end_of(const Bead& bead, const Turn& turn) {
  if (bead.closed) return turn.start.at;
  return turn.reversed ? bead.path.front().at : bead.path.back().at;
}

Turn nearest_turn(const Beads& beads, std::uint32_t block, std::uint32_t bead, std::optional<Point> at) {
  const Bead& b = beads[bead];
  if (b.closed) return {block, bead, at ? nearest_start(b, *at, snap_um) : Start{0, b.path[0].at}, false};
  return {block, bead, {}, at && distance2(*at, b.path.back().at) < distance2(*at, b.path.front().at)};
}

std::vector<Turn> order_walls(const TravelSettings& settings, const Prepared& layer, const Linked& linked,
                              std::uint32_t block, std::optional<Point> from, std::optional<Point> to) {
  if (layer.blocks[block].walls.empty()) return {};
  return WallOrder(settings, layer, linked, block).run(from, to);
}

}  // namespace weft::travel
