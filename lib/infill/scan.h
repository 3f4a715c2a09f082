// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "geometry/spatial_index.h"

#include <cstdint>
#include <span>
#include <vector>

namespace weft::infill {

/// A point in a frame whose x axis runs along the lines of a fill; fractional microns.
struct Turned {
  double x = 0, y = 0;
};

/// The frame: turned by an angle about a point.
class Frame {
 public:
  Frame() = default;
  explicit Frame(double angle_rad, Point origin = {});
  Turned into(Point p) const {
    const double x = p.x - origin_.x, y = p.y - origin_.y;
    return {x * cos_ + y * sin_, y * cos_ - x * sin_};
  }
  Point back(Turned t) const {
    return {origin_.x + rounded(t.x * cos_ - t.y * sin_), origin_.y + rounded(t.x * sin_ + t.y * cos_)};
  }

 private:
  Point origin_;
  double cos_ = 1, sin_ = 0;
};

/// Lines y = first + k·spacing, k = 0 … count − 1.
struct LineSet {
  double first = 0, spacing = 1;
  int count = 0;
  double y(int k) const { return first + k * spacing; }
};

/// Where a line runs inside: between two edges of the outline.
struct Interval {
  int line = 0;
  double from = 0, to = 0;                   ///< x
  std::uint32_t from_edge = 0, to_edge = 0;  ///< edge i runs from point i to its successor
};

/// Outlines in a frame: flat arrays, a ring after the other.
class Outline {
 public:
  Outline(const Region& region, const Frame& frame);
  Outline(const Regions& regions, const Frame& frame);

  const std::vector<Turned>& points() const { return points_; }
  std::uint32_t next(std::uint32_t i) const { return i + 1 < ends_[ring_[i]] ? i + 1 : begin_of(ring_[i]); }
  std::uint32_t previous(std::uint32_t i) const { return i > begin_of(ring_[i]) ? i - 1 : ends_[ring_[i]] - 1; }
  std::uint32_t ring_of(std::uint32_t i) const { return ring_[i]; }
  double least_y() const { return least_y_; }
  double greatest_y() const { return greatest_y_; }

  /// The lines' intervals inside (even-odd), by line and then from left to right.
  /// Cost: O(n + crossings), and a sort of each line's crossings.
  std::vector<Interval> cut(const LineSet& lines) const;

  /// Edges that lie on one of those are loose: what is beyond is filled anyhow, and lines need not fit themselves to
  /// it.
  /// @param frame that of the outline
  void loosen(const geometry::SegmentIndex& edges, const Frame& frame);
  bool is_loose(std::uint32_t edge) const { return !loose_.empty() && loose_[edge]; }
  bool has_loose_edges() const { return !loose_.empty(); }

 private:
  void add(const Ring& ring, const Frame& frame);
  std::uint32_t begin_of(std::uint32_t ring) const { return ring == 0 ? 0 : ends_[ring - 1]; }

  std::vector<Turned> points_;
  std::vector<std::uint32_t> ring_;  // of a point
  std::vector<std::uint32_t> ends_;  // of a ring
  std::vector<bool> loose_;          // edges; empty: none
  double least_y_ = 1e300, greatest_y_ = -1e300;
};

}  // namespace weft::infill
