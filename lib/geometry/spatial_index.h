// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace weft::geometry {

struct Segment {
  Point a, b;
  constexpr Box box() const {
    return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
  }
  friend constexpr bool operator==(const Segment&, const Segment&) = default;
};

/// Which edge of which ring a segment is: ring 0 is the outer one, 1… are the holes; edge i runs from point i to i + 1.
struct EdgeOfRegion {
  std::uint32_t region = 0, ring = 0, edge = 0;
  friend constexpr bool operator==(const EdgeOfRegion&, const EdgeOfRegion&) = default;
};

/// Answers questions about many segments without looking at all of them. Immutable, so any number of threads may ask.
///
/// How it works: a uniform grid of about four cells a segment, cells of 2^k µm, the segments of each cell in one flat
/// array. Cost: built in O(n), about 50 ns a segment; a query looks at the cells it must, usually a handful.
class SegmentIndex {
 public:
  SegmentIndex() = default;
  explicit SegmentIndex(std::vector<Segment> segments);
  /// Every edge of every ring, in their order.
  explicit SegmentIndex(std::span<const Ring> rings);
  explicit SegmentIndex(const Regions& regions);

  std::span<const Segment> segments() const { return segments_; }
  /// Where segment i came from; the ring's number is the region for an index of rings. Pre: made from rings or regions.
  EdgeOfRegion origin(std::size_t i) const { return origins_[i]; }
  const Box& box() const { return box_; }

  struct Nearest {
    std::size_t segment = 0;  ///< the lowest of several equally near
    Point at;                 ///< the nearest point on it, to the nearest micron
    double distance_um = 0;   ///< exact up to double
    double along = 0;         ///< where on the segment, 0 at a … 1 at b
  };
  /// The segment nearest to p; nothing when none is within the limit.
  std::optional<Nearest> nearest(Point p, double limit_um = std::numeric_limits<double>::infinity()) const;

  /// The segments whose cells the box meets: all that meet the box, and some that only come near. Ascending.
  void near(const Box& box, std::vector<std::uint32_t>& found) const;
  /// Whether it finds any.
  bool any_near(const Box& box) const;

  /// A segment met by a line from a to b.
  struct Crossing {
    std::size_t segment = 0;
    double along = 0;     ///< where on a->b, 0 … 1
    bool enters = false;  ///< from the right of the segment to its left: into the region
  };
  /// The segments that a->b crosses, ordered from a to b. A point on a segment counts as being on its right, so a line
  /// through a common end of two segments crosses one, both or none of them: as many as keep the count consistent.
  void crossings(Point a, Point b, std::vector<Crossing>& found) const;

  /// Whether any segment crosses a->b properly (segments_cross in core/point.h): in one point that is an end of
  /// neither.
  bool crosses(Point a, Point b) const;

  /// Whether p is on a segment. Exact.
  bool touches(Point p) const;

  /// How often the segments, taken as closed rings, wind around p; nothing when p is on one of them. Exact.
  std::optional<int> winding(Point p) const;

  /// The same for each ring that p is on or that a ray from p to the left meets, by number. Of a ring that p is on, the
  /// winding counts what the ray meets further left. Pre: made from rings. Exact.
  struct RingWinding {
    std::uint32_t ring = 0;
    int winding = 0;
    bool on = false;  ///< p is on that ring
  };
  void windings(Point p, std::vector<RingWinding>& found) const;

  /// The segment that a ray from p to the left crosses first, those that p is on left out: `none` when it crosses
  /// nothing, `unsure` when it is one of several that meet there. Looks only at the cells between.
  static constexpr std::uint32_t none = ~std::uint32_t{0}, unsure = none - 1;
  std::uint32_t first_left_of(Point p) const;

  /// The region that p is inside of or on the edge of, the lowest of several. Pre: made from regions.
  std::optional<std::size_t> region_at(Point p) const;

  /// The pairs of segments that cross properly, ascending. Exact.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> crossing_pairs() const;

  /// The same where no two segments have another point in common, but for neighbours in a ring their common end; else
  /// nothing. Exact. Pre: made from rings or regions.
  std::optional<std::vector<std::pair<std::uint32_t, std::uint32_t>>> clean_crossings() const;

  /// The pairs of rings that have a point in common, ascending. Exact. Pre: made from rings.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> rings_that_meet() const;

  /// Whether no two segments have a point in common, but for neighbours in a ring their common end. Exact.
  /// Pre: made from rings or regions.
  bool simple() const;

 private:
  struct Cells {
    int first = 0, last = -1;
  };
  void reserve(std::size_t segments);
  void add(const Ring& ring, EdgeOfRegion first);
  void build();
  bool neighbours(std::uint32_t i, std::uint32_t j) const;
  /// Whether two segments that touch are neighbours that share the end only: a fold back would lie on the other.
  bool join(std::uint32_t i, std::uint32_t j) const;
  int column(Um x) const { return (x - box_.min.x) >> shift_; }
  int row(Um y) const { return (y - box_.min.y) >> shift_; }
  static double lean_of(const Segment& s);
  Cells columns_in_row(const Segment& s, double lean, int row) const;
  template <class F>
  void for_each_cell(const Segment& s, F&& f) const;
  template <class F>
  void for_each_left_of(Point p, F&& f) const;
  std::span<const std::uint32_t> cell(std::size_t i) const {
    return {entries_.data() + starts_[i], starts_[i + 1] - starts_[i]};
  }
  template <class F>
  void for_each_near_line(Point a, Point b, F&& f) const;
  /// f(i, s, j, t) of segments s and t whose boxes meet, i before j, once for each cell that both are in, until it
  /// returns false.
  /// @return whether it never did
  template <class F>
  bool for_each_near_pair(F&& f) const;
  /// Whether a segment begins where it ends.
  bool has_points() const;

  std::vector<Segment> segments_;
  std::vector<EdgeOfRegion> origins_;
  std::vector<std::uint32_t> next_;  // the segment that follows in the ring
  Box box_;
  int shift_ = 0, columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> starts_;   // of each cell in entries_, and one more
  std::vector<std::uint32_t> entries_;  // segments, ascending within a cell
};

/// The nearest point of a segment to p, and how far along the segment it is.
struct Foot {
  double along = 0, distance_um = 0;
};
Foot foot_of(Point p, const Segment& segment);

}  // namespace weft::geometry
