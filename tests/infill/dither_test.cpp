// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/dither.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <catch2/catch.hpp>

using namespace weft;
using infill::Dithered;

namespace {

Dithered wedge(std::size_t columns, std::size_t rows) {
  Dithered out{columns, rows, {}, {}, {}};
  for (std::size_t j = 0; j < rows; ++j)
    for (std::size_t i = 0; i < columns; ++i) {
      out.wanted.push_back(0.1 + 0.1 * (static_cast<double>(i) + 0.5) / static_cast<double>(columns));
      out.low.push_back(0.1), out.high.push_back(0.2);
    }
  return out;
}

/// Mean of a quarter of the columns.
double mean_of(const Dithered& cells, const std::vector<bool>& high, std::size_t quarter) {
  double sum = 0, count = 0;
  for (std::size_t n = 0; n < high.size(); ++n)
    if (4 * (n % cells.columns) / cells.columns == quarter) sum += high[n] ? cells.high[n] : cells.low[n], count += 1;
  return sum / count;
}

}  // namespace

TEST_CASE("dither: each part of a wedge has the mean that it is to have", "[infill][law]") {
  const Dithered cells = wedge(64, 64);
  for (const std::vector<bool>& high : {infill::floyd_steinberg(cells), infill::blue_noise(cells, 0, 0, 3)})
    for (std::size_t quarter = 0; quarter < 4; ++quarter) {
      CAPTURE(quarter);
      // of 1024 cells of two values: a twentieth of their difference
      CHECK(mean_of(cells, high, quarter) ==
            Approx(0.1 + 0.1 * (0.125 + 0.25 * static_cast<double>(quarter))).margin(0.005));
    }
}

TEST_CASE("dither: thresholds of the tile are all different, and chosen cells keep apart", "[infill]") {
  const std::vector<double>& tile = infill::blue_noise_tile();
  REQUIRE(tile.size() == 64 * 64);
  CHECK(std::set<double>(tile.begin(), tile.end()).size() == tile.size());
  CHECK(*std::min_element(tile.begin(), tile.end()) == Approx(0.5 / 4096));
  CHECK(*std::max_element(tile.begin(), tile.end()) == Approx(4095.5 / 4096));
  // of a twentieth of all cells, scattered by chance a third would touch another; here none does
  int touching = 0;
  for (int j = 0; j < 64; ++j)
    for (int i = 0; i < 64; ++i) {
      const auto low = [&](int x, int y) { return tile[static_cast<std::size_t>((y & 63) * 64 + (x & 63))] < 0.05; };
      if (low(i, j) && (low(i + 1, j) || low(i, j + 1) || low(i + 1, j + 1) || low(i - 1, j + 1))) ++touching;
    }
  CHECK(touching == 0);
}

TEST_CASE("dither: the pattern of cells moves from layer to layer, and over the lattice as that does", "[infill]") {
  const Dithered cells = wedge(16, 16);
  CHECK(infill::blue_noise(cells, 0, 0, 0) != infill::blue_noise(cells, 0, 0, 1));
  CHECK(infill::blue_noise(cells, 5, 7, 2) == infill::blue_noise(cells, 5 + 64, 7 - 64, 2));
}
