// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace weft::travel {

/// Points in square cells, for "what is nearest" while points are taken away. Indices are those of the span.
class PointGrid {
 public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  /// The points must outlive the grid. Cost: O(n).
  explicit PointGrid(std::span<const Point> points);

  /// The nearest point left; ties go to the lowest index; `none` when there is none left. Cost: O(1) while points lie
  /// evenly.
  std::uint32_t nearest(Point p) const;

  /// Pre: `index` has not been removed.
  void remove(std::uint32_t index);

  /// The `count` nearest of the points left whose index / 2 differs from `except` / 2, nearest first, padded with
  /// `none`.
  void nearest_few(Point p, std::uint32_t except, std::span<std::uint32_t> out) const;

 private:
  template <class Visit>
  void search(Point p, const Visit& visit) const;
  std::size_t cell_of(Point p) const;

  std::span<const Point> points_;
  Box box_;
  std::int64_t cell_ = 1;
  int columns_ = 1, rows_ = 1;
  std::uint32_t left_ = 0;
  std::vector<std::uint32_t> begin_, end_, items_;
};

/// For endpoint lists (2i and 2i + 1 are the ends of stop i): the `count` nearest endpoints of other stops, `count` a
/// point, nearest first, padded with PointGrid::none.
std::vector<std::uint32_t> nearest_neighbours(std::span<const Point> points, int count);

}  // namespace weft::travel
