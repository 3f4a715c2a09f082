// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/wound.h"

#include "geometry/clipper_door.h"
#include "geometry/nesting.h"
#include "geometry/ring_edges.h"
#include "geometry/simplify.h"
#include "geometry/traced.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace weft::geometry {
namespace {

using Crossing = std::pair<std::uint32_t, std::uint32_t>;

/// Where a ring comes by a crossing. Of the two at one crossing each is the other one's `other`.
struct Pass {
  std::uint32_t segment = 0;
  double along = 0;  ///< 0 … 1
  Point at;
  bool to_left = false;  ///< it goes from the right of what it crosses to its left
  std::uint32_t other = 0;
};

/// Rings cut at their crossings into pieces: piece i goes from pass i to the next one of its ring.
class Pieces {
 public:
  Pieces(std::span<const Ring> rings, const RingEdges& edges, std::span<const Crossing> crossings)
      : rings_(rings), edges_(edges) {
    find_passes(crossings);
    clean_ = find_windings() && fits();
  }
  bool clean() const { return clean_; }
  /// Whether anything is wound around negatively.
  bool any_negative() const {
    const auto negative = [](int left) { return left < 1; };
    return std::any_of(left_.begin(), left_.end(), negative) ||
           std::any_of(left_of_begin_.begin(), left_of_begin_.end(), negative);
  }

  /// Outers counter-clockwise, holes clockwise, crossings rounded to whole microns.
  std::vector<Ring> outlines() const {
    std::vector<Ring> out;
    std::vector<char> done(passes_.size(), 0);
    for (std::uint32_t i = 0; i < passes_.size(); ++i)
      if (!done[i] && left_[i] == 1) out.push_back(walk(i, done));
    for (std::uint32_t r = 0; r < rings_.size(); ++r)
      if (from_[r] == from_[r + 1] && left_of_begin_[r] == 1) out.push_back(rings_[r]);
    for (Ring& ring : out) drop_collinear(ring);
    std::erase_if(out, [](const Ring& ring) { return ring.empty(); });
    return out;
  }

 private:
  std::uint32_t ring_of(std::uint32_t segment) const { return edges_.ring_of(segment); }
  std::uint32_t next(std::uint32_t pass) const {
    const std::uint32_t r = ring_of(passes_[pass].segment);
    return pass + 1 < from_[r + 1] ? pass + 1 : from_[r];
  }

  /// In the order in which rings come by them.
  void find_passes(std::span<const Crossing> crossings) {
    passes_.reserve(2 * crossings.size());
    for (const auto& [i, j] : crossings) {
      const Segment s = edges_.edge(i), t = edges_.edge(j);
      const double along = crossed_at(s.a, s.b, t.a, t.b);
      const Point at = lerp(s.a, s.b, along);
      const auto k = static_cast<std::uint32_t>(passes_.size());
      const bool to_left = orient(t.a, t.b, s.b) > 0;
      passes_.push_back({i, along, at, to_left, k + 1});
      passes_.push_back({j, crossed_at(t.a, t.b, s.a, s.b), at, !to_left, k});
    }
    sort_passes();
    from_.assign(rings_.size() + 1, 0);
    for (const Pass& pass : passes_) ++from_[ring_of(pass.segment) + 1];
    for (std::size_t r = 0; r < rings_.size(); ++r) from_[r + 1] += from_[r];
  }
  void sort_passes() {
    std::vector<std::uint32_t> order(passes_.size()), place(passes_.size());
    for (std::uint32_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::uint32_t l, std::uint32_t r) {
      const Pass &x = passes_[l], &y = passes_[r];
      if (x.segment != y.segment) return x.segment < y.segment;
      return x.along != y.along ? x.along < y.along : l < r;
    });
    for (std::uint32_t i = 0; i < order.size(); ++i) place[order[i]] = i;
    std::vector<Pass> sorted;
    sorted.reserve(passes_.size());
    for (const std::uint32_t i : order) {
      sorted.push_back(passes_[i]);
      sorted.back().other = place[sorted.back().other];
    }
    passes_ = std::move(sorted);
  }

  /// The winding number on the left of each piece; on its right it is less by one.
  bool find_windings() {
    left_.resize(passes_.size());
    std::vector<SegmentIndex::RingWinding> windings;
    for (std::uint32_t r = 0; r < rings_.size(); ++r) {
      const Ring& ring = rings_[r];
      const std::size_t n = ring.size();
      const auto leftmost = static_cast<std::size_t>(std::min_element(ring.begin(), ring.end()) - ring.begin());
      edges_.windings(ring[leftmost], windings);
      int around = 0;  // a hair further left
      for (const auto& w : windings)
        if (w.ring != r) around += w.winding;
      const bool turns_left = orient(ring[leftmost == 0 ? n - 1 : leftmost - 1], ring[leftmost],
                                     ring[leftmost + 1 < n ? leftmost + 1 : 0]) > 0;
      const int left = around + (turns_left ? 1 : 0);
      left_of_begin_.push_back(left);
      if (!spread(r, edges_.first_of(r) + static_cast<std::uint32_t>(leftmost), left)) return false;
    }
    return true;
  }
  /// From the begin of a segment on, all around its ring. @return whether it comes back to the same
  bool spread(std::uint32_t r, std::uint32_t segment, int left) {
    const std::uint32_t first = from_[r], end = from_[r + 1];
    if (first == end) return true;
    auto i = static_cast<std::uint32_t>(
        std::partition_point(passes_.begin() + first, passes_.begin() + end,
                             [segment](const Pass& pass) { return pass.segment < segment; }) -
        passes_.begin());
    int now = left;
    for (std::uint32_t k = first; k < end; ++k, ++i) {
      if (i == end) i = first;
      now += passes_[i].to_left ? 1 : -1;
      left_[i] = now;
    }
    return now == left;
  }
  /// Whether outlines that come to a crossing leave it on the other ring.
  bool fits() const {
    std::vector<std::uint32_t> before(passes_.size());
    for (std::uint32_t i = 0; i < passes_.size(); ++i) before[next(i)] = i;
    for (std::uint32_t i = 0; i < passes_.size(); ++i)
      if ((left_[before[i]] == 1 && left_[i] != 1) !=
          (left_[passes_[i].other] == 1 && left_[before[passes_[i].other]] != 1))
        return false;
    return true;
  }

  /// Vertices of a piece but for its ends, as it runs.
  void add_piece(std::uint32_t pass, Ring& out) const {
    const Pass &from = passes_[pass], &to = passes_[next(pass)];
    const std::uint32_t r = ring_of(from.segment), first = edges_.first_of(r);
    const auto n = static_cast<std::uint32_t>(rings_[r].size());
    if (from.segment == to.segment && next(pass) > pass) return;
    std::uint32_t i = from.segment - first;
    do {
      i = i + 1 < n ? i + 1 : 0;
      out.push_back(rings_[r][i]);
    } while (i != to.segment - first);
  }
  Ring walk(std::uint32_t begin, std::vector<char>& done) const {
    Ring out;
    for (std::uint32_t i = begin; !done[i];) {
      done[i] = 1;
      out.push_back(passes_[i].at);
      add_piece(i, out);
      i = passes_[next(i)].other;
    }
    return out;
  }

  std::span<const Ring> rings_;
  const RingEdges& edges_;
  std::vector<Pass> passes_;
  std::vector<std::uint32_t> from_;  // of each ring, its first pass; and one more
  std::vector<int> left_;            // of each piece
  std::vector<int> left_of_begin_;   // of each ring, at its leftmost corner
  bool clean_ = false;
};

}  // namespace

std::optional<Regions> wound(std::span<const Ring> rings, WindingRule rule, Point origin) {
  if (auto alone = convex_alone(rings)) return alone;
  const RingEdges edges(rings);
  const auto crossings = edges.clean_crossings();
  if (!crossings) return std::nullopt;
  if (crossings->empty()) return nested(rings, edges, rule);
  if (rings.size() > most_rings_followed || rule == WindingRule::even_odd) return std::nullopt;
  const Pieces pieces(rings, edges, *crossings);
  if (!pieces.clean() || (rule == WindingRule::nonzero && pieces.any_negative())) return std::nullopt;
  return clipper::tidied(pieces.outlines(), origin);
}

}  // namespace weft::geometry
