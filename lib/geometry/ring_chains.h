// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "geometry/box_columns.h"
#include "geometry/spatial_index.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

/// Where rings cross, and what lies around them; private to geometry/.
namespace weft::geometry {

/// Answers a few questions about rings as a whole, each asked once or a few times, as SegmentIndex would: at a fraction
/// of its cost, as no grid is built and edges far from each other are never looked at.
///
/// How it works: rings are cut into chains that run monotonously along both axes: an outline as parts have them is
/// some four to twenty. No chain meets itself, the box of any piece of one is that of its ends, so pieces that meet are
/// found by halving, and a line across meets each chain in one place, found by bisection. Where rings are many, or
/// hardly any edge continues another, a SegmentIndex answers after all.
/// Cost: about 5 ns an edge to build.
class RingChains {
 public:
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  explicit RingChains(std::span<const Ring> rings);

  /// Edges are numbered through, ring by ring.
  Segment edge(std::uint32_t i) const {
    const Point* at = points_.data() + i + ring_of(i);
    return {at[0], at[1]};
  }
  std::uint32_t ring_of(std::uint32_t edge) const;
  /// The first edge of a ring; that of the ring behind the last: how many edges there are.
  std::uint32_t first_of(std::size_t ring) const { return first_of_ring_[ring]; }

  /// As in SegmentIndex.
  Pairs crossing_pairs() const;
  std::optional<Pairs> clean_crossings() const;
  bool simple() const;
  void windings(Point p, std::vector<SegmentIndex::RingWinding>& found) const;
  static constexpr std::uint32_t none = SegmentIndex::none, unsure = SegmentIndex::unsure;
  std::uint32_t first_left_of(Point p) const;

  /// Whether rings are many and boxes of few are around any of them, as those of islands: what `windings` tells of a
  /// corner then takes a look at few rings only.
  bool scattered() const;

 private:
  struct Chain {
    Box box;
    Point way;  ///< by its signs: where it goes along each axis, if anywhere
    std::uint32_t first = 0, edges = 0, ring = 0;
    std::uint32_t next = 0;  ///< first edge of the chain that follows in the ring
  };
  /// Consecutive edges of a chain.
  struct Piece {
    const Point* at;  ///< edges + 1 of them
    std::uint32_t first, edges;
    Box box() const;
  };
  void cut(std::uint32_t ring);
  static bool only_join(const Chain& a, const Chain& b);
  Piece piece(const Chain& chain) const {
    return {points_.data() + chain.first + chain.ring, chain.first, chain.edges};
  }
  std::span<const Chain> of_ring(std::uint32_t ring) const {
    return {chains_.data() + chains_of_ring_[ring], chains_of_ring_[ring + 1] - chains_of_ring_[ring]};
  }
  const SegmentIndex& grid() const;
  const BoxColumns& columns() const;
  std::optional<SegmentIndex::RingWinding> winding(std::uint32_t ring, Point p) const;
  bool neighbours(std::uint32_t i, std::uint32_t j) const;
  bool join(std::uint32_t i, std::uint32_t j) const;
  enum class Found { all, stopped, too_slow };
  template <class F>
  struct Search;
  /// f(i, s, j, t) of edges of different chains that may meet, i before j, once, until it returns false. Not of those
  /// that join two chains and meet nowhere else.
  /// @param folds  stop at edges that join and lie on each other
  template <class F>
  Found for_each_near_pair(bool folds, F&& f) const;
  /// f(i, a, b) of a chain's edges that have a point at that height, in their order.
  template <class F>
  void for_each_at(const Chain& chain, Um y, F&& f) const;

  std::span<const Ring> rings_;
  std::vector<Point> points_;  // of each ring, its first one again behind its last
  std::vector<std::uint32_t> first_of_ring_;
  std::vector<Chain> chains_;                  // of each ring, by box.min.x
  std::vector<std::uint32_t> chains_of_ring_;  // the first of each ring, and one more
  std::vector<Box> around_;                    // each ring
  bool has_points_ = false;                    // an edge that ends where it begins
  mutable std::unique_ptr<SegmentIndex> grid_;
  mutable std::unique_ptr<BoxColumns> columns_;  // of around_
};

}  // namespace weft::geometry
