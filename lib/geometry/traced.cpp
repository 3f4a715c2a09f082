// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/traced.h"

#include "geometry/aside.h"
#include "geometry/ring_chains.h"
#include "geometry/simplify.h"
#include "geometry/wound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace weft::geometry {
namespace {
using clipper::Operation;

/// Where an outline of a crosses one of b.
struct Crossing {
  Point at;
  bool enters = false;  ///< a goes into b there, so b goes out of a
  struct Place {
    std::uint32_t segment = 0;
    double along = 0;        ///< 0 … 1
    double then = 0;         ///< which of several at one place comes first
    std::uint32_t rank = 0;  ///< among all on that set, as rings run
  };
  std::array<Place, 2> on;  ///< a's and b's segment
};

/// Two sets of outlines, and where they cross.
class Outlines {
 public:
  /// Pre: `rings` are those of a, then, from `first_of_b` on, those of b.
  /// @param operation  of outlines that touch: which is to be no wider, or leave nothing, for what only touches
  Outlines(std::span<const Ring> rings, std::size_t first_of_b, Operation operation)
      : rings_(rings),
        first_of_b_(first_of_b),
        chains_(rings_),
        aside_(rings_, chains_, first_of_b, operation != Operation::intersect) {
    clean_ = find_crossings() && find_order() && find_sides();
  }
  bool clean() const { return clean_; }
  /// Whether any outlines touch, so that each operation has crossings of its own.
  bool touch() const { return touch_; }
  /// The set whose own outlines cross each other, if one does.
  std::optional<std::size_t> crosses_itself() const { return crosses_itself_; }

  std::vector<Ring> left_by(Operation operation) const {
    std::vector<Ring> out;
    std::vector<char> done(crossings_.size(), 0);
    for (std::uint32_t c = 0; c < crossings_.size(); ++c)
      if (!done[c] && crossings_[c].enters == (operation == Operation::intersect))
        out.push_back(walk(c, operation == Operation::subtract, done));
    for (std::uint32_t r = 0; r < rings_.size(); ++r)
      if (!crossed_[r]) add_whole(r, operation, out);
    for (Ring& ring : out) drop_collinear(ring);
    std::erase_if(out, [](const Ring& ring) { return ring.empty(); });
    return out;
  }

 private:
  bool of_b(std::uint32_t ring) const { return ring >= first_of_b_; }
  std::uint32_t ring_of(std::uint32_t segment) const { return chains_.ring_of(segment); }

  bool find_crossings() {
    const auto touching = chains_.touching(chains_.first_of(first_of_b_));
    if (touching.how == RingChains::Touching::How::tangled) crosses_itself_ = touching.set;
    if (touching.how != RingChains::Touching::How::clean) return false;
    crossed_.assign(rings_.size(), 0);
    return std::all_of(touching.pairs.begin(), touching.pairs.end(),
                       [&](const auto& pair) { return add_crossing(pair.first, pair.second); });
  }
  /// Of an edge of a and one of b.
  bool add_crossing(std::uint32_t i, std::uint32_t j) {
    const Segment s = chains_.edge(i), t = chains_.edge(j);
    if (segments_cross(s.a, s.b, t.a, t.b)) {
      const double along = crossed_at(s.a, s.b, t.a, t.b);
      crossings_.push_back({lerp(s.a, s.b, along),
                            orient(t.a, t.b, s.b) > 0,
                            {{{i, along}, {j, crossed_at(t.a, t.b, s.a, s.b)}}}});
    } else {
      touch_ = true;
      Aside::Crossing found;
      const auto how = aside_.find(i, j, found);
      if (how != Aside::Found::crossing) return how == Aside::Found::apart;
      crossings_.push_back(
          {found.at,
           found.enters,
           {{{i, found.along_still, found.then_still}, {j, found.along_moved, found.then_moved}}}});
    }
    crossed_[ring_of(i)] = crossed_[ring_of(j)] = 1;
    return true;
  }

  /// In which order each ring meets its crossings: by turns in and out, or doubles cannot tell.
  bool find_order() {
    for (std::size_t side = 0; side < 2; ++side) {
      auto& next = next_[side];
      auto& before = before_[side];
      std::vector<std::uint32_t> order(crossings_.size());
      std::iota(order.begin(), order.end(), 0U);
      std::sort(order.begin(), order.end(), [&](std::uint32_t l, std::uint32_t r) {
        const auto &x = crossings_[l].on[side], &y = crossings_[r].on[side];
        if (x.segment != y.segment) return x.segment < y.segment;
        return x.along != y.along ? x.along < y.along : x.then < y.then;
      });
      for (std::uint32_t k = 0; k < order.size(); ++k) crossings_[order[k]].on[side].rank = k;
      next.resize(order.size()), before.resize(order.size());
      const auto ring = [&](std::size_t k) { return ring_of(crossings_[order[k]].on[side].segment); };
      for (std::size_t first = 0, end = 0; first < order.size(); first = end) {
        while (end < order.size() && ring(end) == ring(first)) ++end;
        for (std::size_t k = first; k < end; ++k) {
          const std::uint32_t here = order[k], there = order[k + 1 < end ? k + 1 : first];
          if (crossings_[here].enters == crossings_[there].enters) return false;
          next[here] = there, before[there] = here;
        }
      }
    }
    return true;
  }

  /// Whether each set winds as regions do, and on which side of the other set a ring lies that crosses none of it.
  bool find_sides() {
    inside_other_.assign(rings_.size(), 0);
    std::vector<SegmentIndex::RingWinding> windings;
    for (std::uint32_t r = 0; r < rings_.size(); ++r) {
      chains_.windings(rings_[r].front(), windings);
      int own = 0, other = 0;
      bool on_other = false;
      for (const auto& w : windings) {
        if (w.ring == r) continue;
        (of_b(w.ring) == of_b(r) ? own : other) += w.winding;
        on_other |= w.on;
      }
      if (own != (is_outer(r) ? 0 : 1)) return false;
      if (on_other) {
        if (crossed_[r] != 0) continue;
        const auto found = winding_of_other(r);
        if (!found) return false;
        other = *found;
      }
      if (other < 0 || other > 1) return false;
      inside_other_[r] = other == 1;
    }
    return true;
  }
  bool is_outer(std::uint32_t r) const { return double_area(rings_[r]) > 0; }
  /// How often the other set winds around a ring that crosses none of it, but touches it; nothing where none of its
  /// corners can tell.
  std::optional<int> winding_of_other(std::uint32_t r) const {
    std::vector<SegmentIndex::RingWinding> windings;
    const auto at = [&](std::size_t nth) -> std::optional<int> {
      chains_.windings(rings_[r][nth], windings);
      int other = 0;
      for (const auto& w : windings) {
        if (of_b(w.ring) == of_b(r)) continue;
        if (!w.on) {
          other += w.winding;
          continue;
        }
        const auto left = aside_.left_of(r, nth, w.ring);
        if (!left) return std::nullopt;
        other += (is_outer(w.ring) ? 0 : -1) + (*left ? 1 : 0);
      }
      return other;
    };
    for (std::size_t nth = 0; nth < rings_[r].size(); ++nth)
      if (const auto found = at(nth)) return found;
    return std::nullopt;
  }

  /// Vertices between two places of a ring, as it runs.
  void add_between(const Crossing::Place& from, const Crossing::Place& to, Ring& out) const {
    const std::uint32_t r = ring_of(from.segment), first = chains_.first_of(r);
    const auto n = static_cast<std::uint32_t>(rings_[r].size());
    std::uint32_t i = from.segment - first;
    if (from.segment == to.segment && from.rank < to.rank) return;
    do {
      i = i + 1 < n ? i + 1 : 0;
      out.push_back(rings_[r][i]);
    } while (i != to.segment - first);
  }

  /// From a crossing along a to the next, from there along b, and so on until it comes back.
  Ring walk(std::uint32_t begin, bool b_backwards, std::vector<char>& done) const {
    Ring out, back;
    for (std::uint32_t c = begin; !done[c];) {
      done[c] = 1;
      const std::uint32_t turn = next_[0][c], end = b_backwards ? before_[1][turn] : next_[1][turn];
      out.push_back(crossings_[c].at);
      add_between(crossings_[c].on[0], crossings_[turn].on[0], out);
      out.push_back(crossings_[turn].at);
      if (b_backwards) {
        back.clear();
        add_between(crossings_[end].on[1], crossings_[turn].on[1], back);
        out.insert(out.end(), back.rbegin(), back.rend());
      } else {
        add_between(crossings_[turn].on[1], crossings_[end].on[1], out);
      }
      c = end;
    }
    return out;
  }

  void add_whole(std::uint32_t r, Operation operation, std::vector<Ring>& out) const {
    const bool b = of_b(r);
    const bool within = operation == Operation::intersect || (operation == Operation::subtract && b);
    if ((inside_other_[r] != 0) != within) return;
    out.push_back(rings_[r]);
    if (operation == Operation::subtract && b) std::reverse(out.back().begin(), out.back().end());
  }

  std::span<const Ring> rings_;
  std::size_t first_of_b_;
  RingChains chains_;
  Aside aside_;
  std::vector<Crossing> crossings_;
  std::array<std::vector<std::uint32_t>, 2> next_, before_;  // crossing of each, along a and along b
  std::vector<char> crossed_, inside_other_;                 // of each ring
  bool clean_ = false, touch_ = false;
  std::optional<std::size_t> crosses_itself_;
};

std::size_t rings_in(const Regions& regions) {
  return std::accumulate(regions.begin(), regions.end(), std::size_t{0},
                         [](std::size_t sum, const Region& region) { return sum + 1 + region.holes.size(); });
}
}  // namespace

std::optional<std::vector<std::vector<Ring>>> traced(std::span<const Operation> operations, const Regions& a,
                                                     const Regions& b) {
  const std::size_t of_a = rings_in(a);
  if (of_a + rings_in(b) > most_rings_followed) return std::nullopt;
  std::vector<Ring> rings = rings_of(a), more = rings_of(b);
  std::move(more.begin(), more.end(), std::back_inserter(rings));
  if (std::any_of(rings.begin(), rings.end(), [](const Ring& ring) { return ring.size() < 3; })) return std::nullopt;
  std::vector<std::vector<Ring>> out;
  std::optional<Outlines> outlines;
  for (const Operation operation : operations) {
    if (!outlines || outlines->touch()) outlines.emplace(rings, of_a, operation);
    if (!outlines->clean()) {
      const auto tangled = outlines->crosses_itself();
      if (!tangled) return std::nullopt;
      const Regions& set = *tangled == 0 ? a : b;
      std::vector<Ring> own = rings_of(set);
      for (Ring& ring : own) drop_collinear(ring);
      std::erase_if(own, [](const Ring& ring) { return ring.empty(); });
      const auto united = wound(own, WindingRule::nonzero, box_of(set).centre());
      if (!united) return std::nullopt;
      return *tangled == 0 ? traced(operations, *united, b) : traced(operations, a, *united);
    }
    out.push_back(outlines->left_by(operation));
  }
  return out;
}

}  // namespace weft::geometry
