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
    int k = 0;
    at(place, 0) = 0, at(from, 0) = -far_away * 10, at(from, 1) = far_away * 10;
    for (int q = 1; q < n; ++q) {
      const auto meeting = [&](int p) {
        return (at(f, q) + double(q) * q - at(f, p) - double(p) * p) / (2.0 * (q - p));
      };
      double s = meeting(at(place, k));
      while (k > 0 && s <= at(from, k)) s = meeting(at(place, --k));
      if (s <= at(from, k)) {
        at(place, k) = q;
        continue;
      }
      at(place, ++k) = q, at(from, k) = s, at(from, k + 1) = far_away * 10;
    }
    k = 0;
    for (int q = 0; q < n; ++q) {
      while (at(from, k + 1) < q) ++k;
      at(out, q) = double(q - at(place, k)) * (q - at(place, k)) + at(f, at(place, k));
    }
  }
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

}  // namespace weft::support
