// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/traced.h"

#include "geometry/ring_edges.h"
#include "geometry/simplify.h"

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
    double along = 0;  ///< 0 … 1
  };
  std::array<Place, 2> on;  ///< a's and b's segment
};

/// Two sets of outlines, and where they cross.
class Outlines {
 public:
  /// Pre: `rings` are those of a, then, from `first_of_b` on, those of b.
  Outlines(std::vector<Ring> rings, std::size_t first_of_b)
      : rings_(std::move(rings)), first_of_b_(first_of_b), edges_(rings_) {
    clean_ = find_crossings() && find_order() && find_sides();
  }
  bool clean() const { return clean_; }

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
  std::uint32_t ring_of(std::uint32_t segment) const { return edges_.ring_of(segment); }

  bool find_crossings() {
    const auto pairs = edges_.clean_crossings();
    if (!pairs) return false;
    crossed_.assign(rings_.size(), 0);
    for (const auto& [i, j] : *pairs) {  // i < j, so i is a's where they are of different sets
      if (of_b(ring_of(i)) || !of_b(ring_of(j))) return false;
      const Segment s = edges_.edge(i), t = edges_.edge(j);
      const double along = crossed_at(s.a, s.b, t.a, t.b);
      crossings_.push_back(
          {lerp(s.a, s.b, along), orient(t.a, t.b, s.b) > 0, {{{i, along}, {j, crossed_at(t.a, t.b, s.a, s.b)}}}});
      crossed_[ring_of(i)] = crossed_[ring_of(j)] = 1;
    }
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
        return x.segment != y.segment ? x.segment < y.segment : x.along < y.along;
      });
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
      edges_.windings(rings_[r].front(), windings);
      int own = 0, other = 0;
      for (const auto& w : windings)
        if (w.ring != r) (of_b(w.ring) == of_b(r) ? own : other) += w.winding;
      const bool outer = double_area(rings_[r]) > 0;
      if (own != (outer ? 0 : 1) || other < 0 || other > 1) return false;
      inside_other_[r] = other == 1;
    }
    return true;
  }

  /// Vertices between two places of a ring, as it runs.
  void add_between(const Crossing::Place& from, const Crossing::Place& to, Ring& out) const {
    const std::uint32_t r = ring_of(from.segment), first = edges_.first_of(r);
    const auto n = static_cast<std::uint32_t>(rings_[r].size());
    std::uint32_t i = from.segment - first;
    if (from.segment == to.segment && from.along < to.along) return;
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

  std::vector<Ring> rings_;
  std::size_t first_of_b_;
  RingEdges edges_;
  std::vector<Crossing> crossings_;
  std::array<std::vector<std::uint32_t>, 2> next_, before_;  // crossing of each, along a and along b
  std::vector<char> crossed_, inside_other_;                 // of each ring
  bool clean_ = false;
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
  const Outlines outlines(std::move(rings), of_a);
  if (!outlines.clean()) return std::nullopt;
  std::vector<std::vector<Ring>> out;
  for (const Operation operation : operations) out.push_back(outlines.left_by(operation));
  return out;
}

}  // namespace weft::geometry
