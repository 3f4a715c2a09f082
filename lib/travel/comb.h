// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace weft::travel {

/// Up to two rings of a comb that are not looked at.
struct IgnoredRings {
  static constexpr std::uint32_t none = 0xFFFFFFFF;
  std::uint32_t a = none, b = none;
  bool has(std::uint32_t ring) const { return ring == a || ring == b; }
};

/// An area that travels are to stay inside, with an index for "does this segment leave it", "which part of it is this
/// point in", and short ways round its holes and corners. A boundary may be touched: segments are tested against the
/// boundary moved `slack_um` outwards, so that points that lie on it up to rounding count as inside.
class Comb {
 public:
  static constexpr double slack_um = 10;
  static constexpr std::uint32_t outside = 0xFFFFFFFF;

  Comb() = default;
  /// What the rings enclose by the even-odd rule; their orientation does not matter. Cost: O(n) and O(rings²) boxes.
  explicit Comb(std::vector<Ring> rings);
  /// The regions. Cost: O(n).
  explicit Comb(const Regions& regions);

  bool empty() const { return points_.empty(); }

  /// The part that p lies in, or `outside`. Expected cost: the edges of a row of cells.
  std::uint32_t part_of(Point p) const;

  /// The ring of the hole that p lies in, or `outside` where it is in no hole. Cost: as part_of.
  std::uint32_t hole_around(Point p) const;

  /// Whether the segment, one of whose ends is inside, stays inside.
  bool sees(Point a, Point b, IgnoredRings ignored = {}) const;

  /// The nearest point on the boundary, and its distance; none when empty or farther than `within`.
  std::optional<Point> nearest_on_boundary(Point p, Um within) const;

  /// A short way from p to q inside, as the points after p; the last is q.
  /// Pre: part_of(p) == part_of(q) != outside, but that an end may lie in a hole whose ring is ignored.
  /// Returns none where no way was found (rounding, or a boundary that crosses itself).
  /// Method: the straight way; where it leaves, round the ring it hits in the shorter direction; then pulled taut.
  std::optional<Polyline> way(Point p, Point q, IgnoredRings ignored = {}) const;

 private:
  struct Hit {
    double t;
    std::uint32_t edge;
  };
  void add_ring(const Ring& ring, bool is_hole, std::uint32_t part);
  void build_index();
  template <class Visit>
  bool visit_edges(Point a, Point b, const Visit& visit) const;
  std::uint32_t edge_beside(Point p) const;
  void hits(Point p, Point q, IgnoredRings ignored, std::vector<Hit>& out) const;
  Polyline along_rings(Point p, Point q, const std::vector<Hit>& found) const;
  void walk(Polyline& way, std::uint32_t from_edge, std::uint32_t to_edge, Point from, Point to) const;
  bool pull_taut(Polyline& way, IgnoredRings ignored) const;

  struct RingSpan {
    std::uint32_t begin = 0, end = 0, part = 0;  // point `end` is the first once more
    double length = 0;
    bool hole = false;
  };
  std::uint32_t next(std::uint32_t edge) const {
    const auto& ring = rings_[ring_of_[edge]];
    return edge + 1 == ring.end ? ring.begin : edge + 1;
  }

  std::vector<Point> points_;  ///< of all rings; edge i leads from point i to point i + 1, the inside on its left
  std::vector<Point> moved_;   ///< the same, `slack_um` outwards
  std::vector<double> along_;  ///< length of the ring before point i
  std::vector<std::uint32_t> ring_of_;
  std::vector<RingSpan> rings_;
  Box box_;
  std::int64_t cell_ = 1;
  int columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> first_, edges_;  ///< of each cell: edges whose moved segment may touch it
};

}  // namespace weft::travel
