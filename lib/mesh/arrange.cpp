// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/arrange.h"

#include "core/convex_hull.h"
#include "core/error.h"
#include "core/stop.h"
#include "mesh/fits.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

namespace weft::mesh {
namespace {

bool stands_on(const Item& item, Point at, const Plate& plate) {
  Ring shape = *item.hull;
  for (Point& p : shape) p = p + at;
  return lies_in(shape, plate.surface) &&
         std::none_of(plate.keep_out.begin(), plate.keep_out.end(), [&](const Ring& r) { return overlap(shape, r); });
}

bool all_stand_on(std::span<const Item> items, const std::vector<Point>& at, const Plate& plate) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (!stands_on(items[i], at[i], plate)) return false;
  return true;
}

constexpr std::int64_t longest = max_coord / 2;  // of a block of rows

/// Rows of items, in an order of falling depth so that rows are filled well. Lengths in 64 bits: copies may be many.
struct Rows {
  struct Row {
    std::size_t begin, end;  ///< in `order`
    std::int64_t width, depth;
  };
  std::vector<Row> rows;
  std::int64_t width = 0, depth = 0;
};

Rows rows_of(std::span<const Item> items, const std::vector<std::size_t>& order, std::int64_t most_width, Um spacing) {
  Rows result;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Point size = items[order[i]].size;
    if (result.rows.empty() || result.rows.back().width + spacing + size.x > most_width) {
      result.depth += size.y + (result.rows.empty() ? 0 : spacing);
      result.rows.push_back({i, i + 1, size.x, size.y});
    } else {
      result.rows.back().width += spacing + size.x;
      result.rows.back().end = i + 1;
    }
    result.width = std::max(result.width, result.rows.back().width);
  }
  return result;
}

/// Places of the rows' items, each row centred, all around `middle`.
/// Pre: no row and no column of rows is longer than `longest`.
std::vector<Point> places_in(const Rows& rows, std::span<const Item> items, const std::vector<std::size_t>& order,
                             Point middle, Um spacing) {
  std::vector<Point> at(items.size());
  Um y = middle.y - static_cast<Um>(rows.depth / 2);
  for (const Rows::Row& row : rows.rows) {
    Um x = middle.x - static_cast<Um>(row.width / 2);
    for (std::size_t i = row.begin; i < row.end; ++i) {
      const Point size = items[order[i]].size;
      at[order[i]] = {x + size.x / 2, y + static_cast<Um>(row.depth) / 2};
      x += size.x + spacing;
    }
    y += static_cast<Um>(row.depth) + spacing;
  }
  return at;
}

/// Cells of one size, in a grid around the middle of the plate, on which the largest item can stand: nearest first.
std::vector<Point> cells_on(const Plate& plate, const Item& largest, Point pitch, Point middle, bool odd_x,
                            bool odd_y) {
  const Box box = box_of(plate.surface);
  const Um columns = box.size().x / pitch.x + 1, rows = box.size().y / pitch.y + 1;
  std::vector<Point> cells;
  for (Um row = -rows; row <= rows; ++row) {
    stop_if_asked();
    for (Um column = -columns; column <= columns; ++column) {
      const Point at{middle.x + column * pitch.x + (odd_x ? 0 : pitch.x / 2),
                     middle.y + row * pitch.y + (odd_y ? 0 : pitch.y / 2)};
      if (box.contains(at) && stands_on(largest, at, plate)) cells.push_back(at);
    }
  }
  std::stable_sort(cells.begin(), cells.end(),
                   [&](Point a, Point b) { return distance2(a, middle) < distance2(b, middle); });
  return cells;
}

std::optional<std::vector<Point>> in_cells(std::span<const Item> items, const Plate& plate, Point middle, Um spacing) {
  Point size{0, 0};
  std::vector<Point> corners;
  for (const Item& item : items) {
    size = {std::max(size.x, item.size.x), std::max(size.y, item.size.y)};
    corners.insert(corners.end(), item.hull->begin(), item.hull->end());
  }
  const Ring hull = convex_hull(std::move(corners));
  const Point pitch{std::max(size.x + spacing, 1_mm), std::max(size.y + spacing, 1_mm)};
  std::optional<std::vector<Point>> best;
  for (const bool odd_x : {true, false})
    for (const bool odd_y : {true, false}) {
      std::vector<Point> cells = cells_on(plate, {size, &hull}, pitch, middle, odd_x, odd_y);
      if (cells.size() < items.size()) continue;
      cells.resize(items.size());
      if (!best || distance2(cells.back(), middle) < distance2(best->back(), middle)) best = std::move(cells);
    }
  if (best) std::sort(best->begin(), best->end(), [](Point a, Point b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  return best;
}

}  // namespace

Arrangement arrange(std::span<const Item> items, const Plate& plate, std::optional<Point> center, Um spacing) {
  const Box bed = box_of(plate.surface);
  const Point middle = center.value_or(bed.centre());
  std::vector<std::size_t> order(items.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return items[a].size.y > items[b].size.y; });

  // Of all numbers of columns the one whose block takes the least of the plate, among those that fit if any does.
  Arrangement best;
  double best_share = 0;
  std::int64_t first_row = -spacing;
  for (const std::size_t i : order) {
    stop_if_asked();
    first_row += spacing + items[i].size.x;
    if (i != order.front() && first_row > bed.size().x) break;
    const Rows rows = rows_of(items, order, first_row, spacing);
    const double share =
        std::max(static_cast<double>(rows.width) / bed.size().x, static_cast<double>(rows.depth) / bed.size().y);
    if (rows.width > longest || rows.depth > longest || (best.fits && share >= best_share)) continue;
    std::vector<Point> at = places_in(rows, items, order, middle, spacing);
    const bool fits = share <= 1 && all_stand_on(items, at, plate);
    if (best.at.empty() || (fits && !best.fits) || (fits == best.fits && share < best_share))
      best = {std::move(at), fits}, best_share = share;
  }
  if (best.at.empty())
    throw Error(Error::Kind::audit,
                fmt::format("{} models side by side are longer than {} m", items.size(), longest / 1'000'000),
                "--copies", "print fewer at a time");
  if (!best.fits && !center)
    if (auto cells = in_cells(items, plate, middle, spacing)) return {std::move(*cells), true};
  return best;
}

}  // namespace weft::mesh
