// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

/// Outlines as cells of a grid, and how far cells are from each other.
namespace weft::support {

/// Squared distance, in cells, where there is nothing near: more than three axes of reach make, 3 · 5².
inline constexpr std::uint8_t far_away = 100;

/// One pass, along an axis, of a squared distance transform of what is near: each cell gets the least of what cells of
/// its line have, plus the square of how far they are. One pass along each of three axes makes distances of zeros.
/// Pre: cells of a line lie `stride` apart in memory, lines fill blocks of `count` times that; reach is 5 at most, so
///      that no sum is too large for a byte
/// Cost: two looks at each cell for each cell of reach, in a loop over bytes that compilers vectorise.
void spread_squares(std::vector<std::uint8_t>& squares, std::size_t count, std::size_t stride, std::size_t reach);

/// Squared distance, in cells, of each cell of rows of so many to the nearest one that is not 0, but at most most²:
/// what is further counts for nothing. Exact.
std::vector<int> squared_distances(const std::vector<std::uint8_t>& cells, std::size_t columns, int most);

/// Calls set(column, row) for the cells whose middle is inside of the regions.
template <class Set>
void rasterize(const Regions& regions, Point origin, Um cell, int columns, int rows, Set set) {
  std::vector<std::vector<double>> crossings(static_cast<std::size_t>(rows));
  const auto add = [&](const Ring& ring) {
    for (std::size_t i = 0, j = ring.size() - 1; i < ring.size(); j = i++) {
      const Point a = ring[j], b = ring[i];
      if (a.y == b.y) continue;
      const double low = std::min(a.y, b.y), high = std::max(a.y, b.y);
      const int from = std::max(0, static_cast<int>(std::ceil((low - origin.y) / cell - 0.5)));
      const int to = std::min(rows - 1, static_cast<int>(std::ceil((high - origin.y) / cell - 0.5)) - 1);
      for (int r = from; r <= to; ++r) {
        const double y = origin.y + (r + 0.5) * cell;
        crossings[static_cast<std::size_t>(r)].push_back(a.x + (y - a.y) * (double(b.x) - a.x) / (double(b.y) - a.y));
      }
    }
  };
  for (const Region& region : regions) {
    add(region.outer);
    for (const Ring& hole : region.holes) add(hole);
  }
  for (int r = 0; r < rows; ++r) {
    auto& row = crossings[static_cast<std::size_t>(r)];
    std::sort(row.begin(), row.end());
    for (std::size_t i = 0; i + 1 < row.size(); i += 2) {
      const int from = std::max(0, static_cast<int>(std::ceil((row[i] - origin.x) / cell - 0.5)));
      const int to = std::min(columns - 1, static_cast<int>(std::ceil((row[i + 1] - origin.x) / cell - 0.5)) - 1);
      for (int c = from; c <= to; ++c) set(c, r);
    }
  }
}

}  // namespace weft::support
