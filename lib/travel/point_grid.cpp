// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/point_grid.h"

#include "core/stop.h"

#include <algorithm>
#include <cmath>

namespace weft::travel {

PointGrid::PointGrid(std::span<const Point> points)
    : points_(points), box_(box_of(points)), left_(static_cast<std::uint32_t>(points.size())) {
  if (points.empty()) return;
  const double w = box_.size().x + 1.0, h = box_.size().y + 1.0;
  const double per_cell = 2.0;
  cell_ = std::max<std::int64_t>(
      1, static_cast<std::int64_t>(std::ceil(std::sqrt(w * h * per_cell / static_cast<double>(points.size())))));
  // A thin row of points must not make more cells than points.
  cell_ = std::max(cell_, static_cast<std::int64_t>(std::max(w, h) / (static_cast<double>(points.size()) + 1.0)) + 1);
  columns_ = static_cast<int>(box_.size().x / cell_) + 1;
  rows_ = static_cast<int>(box_.size().y / cell_) + 1;
  const std::size_t cells = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  std::vector<std::uint32_t> start(cells + 1, 0);
  for (const Point p : points) ++start[cell_of(p) + 1];
  for (std::size_t c = 0; c < cells; ++c) start[c + 1] += start[c];
  begin_.assign(start.begin(), start.end() - 1);
  end_ = begin_;
  items_.resize(points.size());
  for (std::uint32_t i = 0; i < points.size(); ++i) items_[end_[cell_of(points[i])]++] = i;
}

std::size_t PointGrid::cell_of(Point p) const {
  const auto column = static_cast<std::size_t>((p.x - box_.min.x) / cell_),
             row = static_cast<std::size_t>((p.y - box_.min.y) / cell_);
  return row * static_cast<std::size_t>(columns_) + column;
}

void PointGrid::remove(std::uint32_t index) {
  const std::size_t c = cell_of(points_[index]);
  for (std::uint32_t k = begin_[c]; k < end_[c]; ++k)
    if (items_[k] == index) {
      items_[k] = items_[--end_[c]];
      --left_;
      return;
    }
}

/// Visits cells in growing square rings around p; `visit(items)` returns the squared distance beyond which nothing
/// matters.
template <class Visit>
void PointGrid::search(Point p, const Visit& visit) const {
  const int px = static_cast<int>(std::clamp<std::int64_t>((std::int64_t{p.x} - box_.min.x) / cell_, 0, columns_ - 1));
  const int py = static_cast<int>(std::clamp<std::int64_t>((std::int64_t{p.y} - box_.min.y) / cell_, 0, rows_ - 1));
  const Point inside{std::clamp(p.x, box_.min.x, box_.max.x), std::clamp(p.y, box_.min.y, box_.max.y)};
  const double to_box2 = static_cast<double>(distance2(p, inside));
  double limit2 = std::numeric_limits<double>::infinity();
  const auto cell = [&](int x, int y) {
    const std::size_t c =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
    if (begin_[c] != end_[c]) limit2 = visit(std::span(items_).subspan(begin_[c], end_[c] - begin_[c]));
  };
  for (int r = 0; r < std::max(columns_, rows_); ++r) {
    const double clear =
        static_cast<double>(r - 1) * static_cast<double>(cell_);  // rings from r on are farther than this
    if (r > 0 && clear > 0 && clear * clear + to_box2 > limit2) break;
    const int x0 = px - r, x1 = px + r, y0 = py - r, y1 = py + r;
    for (int y = std::max(y0, 0); y <= std::min(y1, rows_ - 1); ++y) {
      const bool whole = y == y0 || y == y1;
      if (whole) {
        for (int x = std::max(x0, 0); x <= std::min(x1, columns_ - 1); ++x) cell(x, y);
      } else {
        if (x0 >= 0) cell(x0, y);
        if (x1 < columns_ && x1 != x0) cell(x1, y);
      }
    }
  }
}

std::uint32_t PointGrid::nearest(Point p) const {
  std::uint32_t best = none;
  if (left_ == 0) return best;
  std::int64_t best2 = std::numeric_limits<std::int64_t>::max();
  search(p, [&](std::span<const std::uint32_t> items) {
    for (const std::uint32_t i : items) {
      const std::int64_t d2 = distance2(p, points_[i]);
      if (d2 < best2 || (d2 == best2 && i < best)) best = i, best2 = d2;
    }
    return static_cast<double>(best2);
  });
  return best;
}

void PointGrid::nearest_few(Point p, std::uint32_t except, std::span<std::uint32_t> out) const {
  std::fill(out.begin(), out.end(), none);
  std::size_t found = 0;
  const auto farther = [&](std::uint32_t a, std::uint32_t b) {
    const std::int64_t da = distance2(p, points_[a]), db = distance2(p, points_[b]);
    return da < db || (da == db && a < b);
  };
  search(p, [&](std::span<const std::uint32_t> items) {
    for (const std::uint32_t i : items) {
      if (i / 2 == except / 2) continue;
      if (found == out.size() && !farther(i, out[found - 1])) continue;
      std::size_t k = found < out.size() ? found++ : found - 1;
      for (; k > 0 && farther(i, out[k - 1]); --k) out[k] = out[k - 1];
      out[k] = i;
    }
    return found == out.size() ? static_cast<double>(distance2(p, points_[out[found - 1]]))
                               : std::numeric_limits<double>::infinity();
  });
}

std::vector<std::uint32_t> nearest_neighbours(std::span<const Point> points, int count) {
  const auto width = static_cast<std::size_t>(count);
  std::vector<std::uint32_t> lists(points.size() * width);
  const PointGrid grid(points);
  StopNowAndThen stop(64);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    stop.step();
    grid.nearest_few(points[i], i, std::span(lists).subspan(i * width, width));
  }
  return lists;
}

}  // namespace weft::travel
