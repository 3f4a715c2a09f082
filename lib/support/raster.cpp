// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/raster.h"

namespace weft::support {
namespace {

/// Lower envelope of parabolas: of each place the least of f(q) + (p - q)², by the parabolas' places and where each
/// begins to be the lowest.
struct Envelope {
  std::vector<double> from;
  std::vector<int> place;

  void of(const std::vector<double>& f, std::vector<double>& out) {
    const int n = static_cast<int>(f.size());
    const auto at = [](auto& list, int i) -> auto& {
      return list[static_cast<std::size_t>(i)];
    };
    from.resize(f.size() + 1), place.resize(f.size());
    int k = -1;
    for (int q = 0; q < n; ++q) {
      if (at(f, q) >= far_away) continue;
      const auto meeting = [&](int p) {
        return (at(f, q) + double(q) * q - at(f, p) - double(p) * p) / (2.0 * (q - p));
      };
      double s = -far_away;
      while (k >= 0 && (s = meeting(at(place, k))) <= at(from, k)) --k;
      if (k < 0) s = -far_away;
      at(place, ++k) = q, at(from, k) = s;
    }
    if (k < 0) return std::fill(out.begin(), out.end(), far_away);
    at(from, k + 1) = far_away;
    k = 0;
    for (int q = 0; q < n; ++q) {
      while (at(from, k + 1) < q) ++k;
      at(out, q) = double(q - at(place, k)) * (q - at(place, k)) + at(f, at(place, k));
    }
  }
};

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

void spread_squares(std::vector<double>& squares, const GridLines& along) {
  Envelope envelope;
  std::vector<double> line(along.count), result(along.count);
  for (std::size_t l = 0; l < along.lines; ++l) {
    double* const first = squares.data() + l * along.between;
    for (std::size_t i = 0; i < along.count; ++i) line[i] = first[i * along.stride];
    envelope.of(line, result);
    for (std::size_t i = 0; i < along.count; ++i) first[i * along.stride] = result[i];
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
