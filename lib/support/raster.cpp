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
  Envelope envelope;
  std::vector<double> row(columns), result(columns);
  for (std::size_t first = 0; first + columns <= out.size(); first += columns) {
    int* const cell = out.data() + first;
    for (std::size_t i = 0; i < columns; ++i) row[i] = cell[i] < most ? cell[i] * cell[i] : far_away;
    envelope.of(row, result);
    for (std::size_t i = 0; i < columns; ++i) cell[i] = static_cast<int>(std::min<double>(result[i], most * most));
  }
  return out;
}

}  // namespace weft::support
