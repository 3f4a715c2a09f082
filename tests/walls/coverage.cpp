// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/coverage.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace weft::test {
namespace {

/// One cell of the raster, and the stroke that covered it last.
struct Cell {
  std::uint8_t times = 0;
  bool part = false, inside = false;
  std::uint32_t bead = 0;  // its number from 1
  float along = 0;         // how far along it
};

class Raster {
 public:
  Raster(const Box& box, Um size)
      : size_(size),
        corner_(box.min),
        columns_((box.max.x - box.min.x) / size + 1),
        rows_((box.max.y - box.min.y) / size + 1),
        cells_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {}

  /// Cells with their middle in the regions, by counting how often a ray from the left crosses a ring.
  void mark(const Regions& regions, bool Cell::*what) {
    std::vector<double> crossings;
    for (Um row = 0; row < rows_; ++row) {
      const double y = middle(corner_.y, row);
      crossings.clear();
      for (const Region& region : regions) {
        cross(region.outer, y, crossings);
        for (const Ring& hole : region.holes) cross(hole, y, crossings);
      }
      std::sort(crossings.begin(), crossings.end());
      for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
        for (Um column = column_from(crossings[i]); column < column_from(crossings[i + 1]); ++column)
          at(column, row).*what = true;
    }
  }

  /// All the discs of a bead. Where it comes back over itself, and is not just bending, it counts again.
  void lay(const Bead& bead, std::uint32_t number) {
    const std::size_t segments = bead.path.size() - (bead.closed ? 0 : 1);
    double length = 0, along = 0;
    for (std::size_t k = 0; k < segments; ++k)
      length += distance(bead.path[k].at, bead.path[(k + 1) % bead.path.size()].at);
    for (std::size_t k = 0; k < segments; ++k) {
      const Junction &a = bead.path[k], &b = bead.path[(k + 1) % bead.path.size()];
      sweep(a, b, number, along, bead.closed ? length : 0);
      along += distance(a.at, b.at);
    }
  }

  Coverage count() const {
    Coverage out;
    const double area = to_mm(size_) * to_mm(size_);
    for (const Cell& cell : cells_) {
      const bool walled = cell.part && !cell.inside;
      if (walled) out.walled += area;
      if (walled && cell.times == 0) out.bare += area;
      if (cell.part && cell.times > 1) out.twice += area;
      if (!cell.part && cell.times > 0) out.outside += area;
    }
    return out;
  }

 private:
  double middle(Um corner, Um index) const { return corner + (static_cast<double>(index) + 0.5) * size_; }
  Um column_from(double x) const {
    return std::clamp(static_cast<Um>(std::ceil((x - corner_.x) / size_ - 0.5)), Um{0}, columns_);
  }
  Cell& at(Um column, Um row) {
    return cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(column)];
  }

  static void cross(const Ring& ring, double y, std::vector<double>& out) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i], b = ring[(i + 1) % ring.size()];
      if ((a.y < y) != (b.y < y)) out.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
  }

  void sweep(const Junction& a, const Junction& b, std::uint32_t number, double along, double loop) {
    const double ra = a.width / 2.0, rb = b.width / 2.0, most = std::max(ra, rb);
    const double dx = b.at.x - a.at.x, dy = b.at.y - a.at.y, length2 = dx * dx + dy * dy, length = std::sqrt(length2);
    const auto first = [&](double low, Um corner) {
      return std::max(Um{0}, static_cast<Um>(std::floor((low - most - corner) / size_ - 0.5)));
    };
    const auto end = [&](double high, Um corner, Um count) {
      return std::min(count, static_cast<Um>(std::ceil((high + most - corner) / size_ + 0.5)));
    };
    const Um columns = end(std::max(a.at.x, b.at.x), corner_.x, columns_);
    const Um rows = end(std::max(a.at.y, b.at.y), corner_.y, rows_);
    for (Um row = first(std::min(a.at.y, b.at.y), corner_.y); row < rows; ++row)
      for (Um column = first(std::min(a.at.x, b.at.x), corner_.x); column < columns; ++column) {
        const double px = middle(corner_.x, column) - a.at.x, py = middle(corner_.y, row) - a.at.y;
        const double t = length2 > 0 ? std::clamp((px * dx + py * dy) / length2, 0.0, 1.0) : 0;
        const double ex = px - t * dx, ey = py - t * dy, r = ra + t * (rb - ra);
        if (ex * ex + ey * ey <= r * r) cover(at(column, row), number, along + t * length, loop, 3 * most);
      }
  }

  /// @param again along the bead: what is further from its last time there is another time
  static void cover(Cell& cell, std::uint32_t number, double along, double loop, double again) {
    double since = std::abs(along - static_cast<double>(cell.along));
    if (loop > 0) since = std::min(since, loop - since);
    const bool new_time = cell.bead != number || since > again;
    if (new_time && cell.times < 255) ++cell.times;
    cell.bead = number;
    cell.along = static_cast<float>(along);
  }

  Um size_;
  Point corner_;
  Um columns_, rows_;
  std::vector<Cell> cells_;
};

}  // namespace

Coverage coverage_of(const Regions& regions, const WallLayer& walls, Um cell) {
  constexpr Um margin = 1000;
  Box box = box_of(regions);
  if (box.empty()) return {};
  box.min = box.min - Point{margin, margin}, box.max = box.max + Point{margin, margin};
  Raster raster(box, cell);
  raster.mark(regions, &Cell::part);
  raster.mark(walls.inside, &Cell::inside);
  std::uint32_t number = 0;
  for (const Bead& bead : walls.beads) raster.lay(bead, ++number);
  return raster.count();
}

}  // namespace weft::test
