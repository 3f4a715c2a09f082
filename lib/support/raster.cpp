// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/raster.h"

namespace weft::support {
namespace {

/// How far each cell of a column is from the nearest one that is not 0, but at most so far.
std::vector<int> along_columns(const std::vector<std::uint8_t>& cells, std::size_t columns, int most) {
  std::vector<int> out(cells.size(), most);
  for (std::size_t i = 0; i < cells.size(); ++i)
    out[i] = cells[i] != 0 ? 0 : std::min(most, (i < columns ? most : out[i - columns]) + 1);
  for (std::size_t i = cells.size(); i-- > columns;) out[i - columns] = std::min(out[i - columns], out[i] + 1);
  return out;
}

/// The other pass, over rows, of whole numbers.
/// Source: Meijster, Roerdink, Hesselink 2000, "A general algorithm for computing distance transforms in linear time".
class NearestInRow {
 public:
  explicit NearestInRow(std::size_t columns) : nearest_(columns) {}

  /// @param row  how far each cell is from the nearest one of its column, at most so far; becomes squares of how far
  ///             it is from the nearest of all
  void of(std::span<int> row, int most) {
    const int n = static_cast<int>(row.size());
    std::size_t count = 0;
    for (int u = 0; u < n; ++u) {
      const int g = row[static_cast<std::size_t>(u)];
      if (g >= most) continue;
      int from = 0;
      while (count > 0) {
        const Reign& last = nearest_[count - 1];
        const int lead = u * u - last.at * last.at + g * g - last.square, twice = 2 * (u - last.at);
        // u is nearer than the last from the cell after that on; where that is no further than the last begins, it is
        // nearer wherever the last was.
        from = lead < 0 ? 0 : lead / twice + 1;
        if (from > last.from) break;
        --count, from = 0;
      }
      if (from < n) nearest_[count++] = {u, g * g, from};
    }
    if (count == 0) return std::fill(row.begin(), row.end(), most * most);
    for (std::size_t i = 0; i < count; ++i) {
      const Reign& reign = nearest_[i];
      const int end = i + 1 < count ? nearest_[i + 1].from : n;
      for (int x = reign.from; x < end; ++x)
        row[static_cast<std::size_t>(x)] = std::min((x - reign.at) * (x - reign.at) + reign.square, most * most);
    }
  }

 private:
  /// The cells from one on that have the same nearest column.
  struct Reign {
    int at, square, from;
  };
  std::vector<Reign> nearest_;
};

}  // namespace

void spread_squares(std::vector<std::uint8_t>& squares, std::size_t count, std::size_t stride, std::size_t reach) {
  const std::vector<std::uint8_t> before = squares;
  const std::size_t block = count * stride;
  const auto lessen = [](std::uint8_t* to, const std::uint8_t* from, std::size_t cells, std::uint8_t more) {
    for (std::size_t i = 0; i < cells; ++i) to[i] = std::min(to[i], static_cast<std::uint8_t>(from[i] + more));
  };
  for (std::size_t first = 0; first < squares.size(); first += block)
    for (std::size_t away = 1; away <= reach && away < count; ++away) {
      const std::size_t by = away * stride;
      const auto more = static_cast<std::uint8_t>(away * away);
      lessen(squares.data() + first + by, before.data() + first, block - by, more);
      lessen(squares.data() + first, before.data() + first + by, block - by, more);
    }
}

std::vector<int> squared_distances(const std::vector<std::uint8_t>& cells, std::size_t columns, int most) {
  std::vector<int> out = along_columns(cells, columns, most);
  NearestInRow nearest(columns);
  for (std::size_t first = 0; first + columns <= out.size(); first += columns)
    nearest.of({out.data() + first, columns}, most);
  return out;
}

}  // namespace weft::support
