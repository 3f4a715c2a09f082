// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "geometry/box_columns.h"
#include "geometry/eight_boxes.h"
#include "geometry/spatial_index.h"

#include <array>
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
/// How it works: each eight edges that follow each other in a ring are a block, each eight blocks a group; of the eight
/// boxes in one those that meet a box are told at once, and what lies beside each other along a ring mostly lies near
/// to each other. Edges of a block that go one way along an axis do not meet, nor do two such blocks that follow each
/// other. Where rings are many, or most edges are near to most others, a SegmentIndex answers after all.
/// Cost: O(n) to build.
class RingEdges {
 public:
  using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

  explicit RingEdges(std::span<const Ring> rings);

  /// Edges are numbered through, ring by ring.
  Segment edge(std::uint32_t i) const { return edge_of(ring_of(i), i); }
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
  struct Block {
    using Places = std::array<Um, EightBoxes::count + 1>;
    Block(const Places& x, const Places& y) : edges(x, y) {}
    EightBoxes edges;
    std::uint32_t first = 0, count = 0;  ///< its edges
    unsigned ways = 0;                   ///< where they go, as bits
  };
  struct Group {
    EightBoxes blocks;
    Box box;
    std::uint32_t first = 0, count = 0;  ///< its blocks
  };
  static bool goes_one_way(unsigned ways);
  static bool keeps_quadrant(unsigned ways);
  void add(std::uint32_t ring);
  Box add_block(const Point* at, std::uint32_t first, std::uint32_t count);
  Segment edge_of(std::uint32_t ring, std::uint32_t i) const {
    const Point* at = points_.data() + i + ring;
    return {at[0], at[1]};
  }
  std::span<const Group> of_ring(std::uint32_t ring) const {
    return {groups_.data() + groups_of_ring_[ring], groups_of_ring_[ring + 1] - groups_of_ring_[ring]};
  }
  std::span<const Block> blocks_of(std::uint32_t ring) const;
  bool any_folds() const;
  const SegmentIndex& grid() const;
  const BoxColumns& columns() const;
  std::optional<SegmentIndex::RingWinding> winding(std::uint32_t ring, Point p) const;
  enum class Found { all, stopped, too_slow };
  template <class F>
  struct Search;
  /// f(i, s, j, t) of edges whose boxes meet, i before j, once, until it returns false. Not of those that follow each
  /// other, nor of those that do not meet because of where they go.
  /// Pre: no edges that follow each other lie on each other, or it does not matter
  template <class F>
  Found for_each_near_pair(F&& f) const;
  /// f(i, a, b) of a ring's edges whose boxes meet that one.
  template <class F>
  void for_each_in(std::uint32_t ring, const Box& box, F&& f) const;

  std::span<const Ring> rings_;
  std::vector<Point> points_;  // of each ring, its first one again behind its last
  std::vector<std::uint32_t> first_of_ring_;
  std::vector<Block> blocks_;
  std::vector<Group> groups_;                  // of one ring each
  std::vector<std::uint32_t> groups_of_ring_;  // the first of each ring, and one more
  std::vector<Box> around_;                    // each ring
  bool has_points_ = false;                    // an edge that ends where it begins
  mutable std::unique_ptr<SegmentIndex> grid_;
  mutable std::unique_ptr<BoxColumns> columns_;  // of around_
};

}  // namespace weft::geometry
