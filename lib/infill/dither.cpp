// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/dither.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace weft::infill {
namespace {

constexpr std::size_t side = 64, all = side * side;

/// How crowded places are around the chosen ones, on a tile that repeats.
class Crowd {
 public:
  Crowd() {
    constexpr double sigma = 1.9;
    for (std::size_t j = 0; j < side; ++j)
      for (std::size_t i = 0; i < side; ++i) {
        const auto d = [](std::size_t k) { return static_cast<double>(std::min(k, side - k)); };
        weight_[j * side + i] = std::exp(-(d(i) * d(i) + d(j) * d(j)) / (2 * sigma * sigma));
      }
  }
  void set(std::size_t at, bool chosen) {
    chosen_[at] = chosen;
    const double sign = chosen ? 1 : -1;
    const std::size_t x = at % side, y = at / side;
    for (std::size_t j = 0; j < side; ++j)
      for (std::size_t i = 0; i < side; ++i)
        energy_[j * side + i] += sign * weight_[(j + side - y) % side * side + (i + side - x) % side];
  }
  bool chosen(std::size_t at) const { return chosen_[at]; }
  /// The chosen place with most others around it; of the first such.
  std::size_t tightest() const {
    std::size_t best = all;
    for (std::size_t k = 0; k < all; ++k)
      if (chosen_[k] && (best == all || energy_[k] > energy_[best] + 1e-12)) best = k;
    return best;
  }
  /// The free place with fewest around it.
  std::size_t loosest() const {
    std::size_t best = all;
    for (std::size_t k = 0; k < all; ++k)
      if (!chosen_[k] && (best == all || energy_[k] < energy_[best] - 1e-12)) best = k;
    return best;
  }

 private:
  std::array<double, all> weight_{}, energy_{};
  std::array<bool, all> chosen_{};
};

std::vector<double> made_tile() {
  Crowd crowd;
  std::uint64_t state = 1;
  constexpr std::size_t seeds = all / 10;
  for (std::size_t n = 0; n < seeds;) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    const std::size_t at = (state >> 33U) % all;
    if (!crowd.chosen(at)) crowd.set(at, true), ++n;
  }
  for (std::size_t round = 0; round < all; ++round) {
    const std::size_t from = crowd.tightest();
    crowd.set(from, false);
    const std::size_t to = crowd.loosest();
    crowd.set(to, true);
    if (from == to) break;
  }
  std::vector<double> rank(all, 0);
  Crowd fewer = crowd;
  for (std::size_t n = seeds; n-- > 0;) {
    const std::size_t at = fewer.tightest();
    fewer.set(at, false);
    rank[at] = static_cast<double>(n);
  }
  for (std::size_t n = seeds; n < all; ++n) {
    const std::size_t at = crowd.loosest();
    crowd.set(at, true);
    rank[at] = static_cast<double>(n);
  }
  for (double& r : rank) r = (r + 0.5) / static_cast<double>(all);
  return rank;
}

}  // namespace

std::vector<bool> floyd_steinberg(const Dithered& cells) {
  std::vector<bool> out(cells.wanted.size(), false);
  std::vector<double> carried(cells.wanted.size(), 0);
  for (std::size_t j = 0; j < cells.rows; ++j)
    for (std::size_t k = 0; k < cells.columns; ++k) {
      const bool back = j % 2 == 1;
      const std::size_t i = back ? cells.columns - 1 - k : k, n = j * cells.columns + i;
      const double v = cells.wanted[n] + carried[n];
      out[n] = v > (cells.low[n] + cells.high[n]) / 2;
      const double error = (v - (out[n] ? cells.high[n] : cells.low[n])) / 16;
      const bool ahead = back ? i > 0 : i + 1 < cells.columns, behind = back ? i + 1 < cells.columns : i > 0;
      const std::size_t next = back ? n - 1 : n + 1, last = back ? n + 1 : n - 1;
      if (ahead) carried[next] += 7 * error;
      if (j + 1 == cells.rows) continue;
      if (behind) carried[last + cells.columns] += 3 * error;
      carried[n + cells.columns] += 5 * error;
      if (ahead) carried[next + cells.columns] += error;
    }
  return out;
}

const std::vector<double>& blue_noise_tile() {
  static const std::vector<double> tile = made_tile();
  return tile;
}

std::vector<bool> blue_noise(const Dithered& cells, long first_column, long first_row, std::size_t layer) {
  const std::vector<double>& tile = blue_noise_tile();
  constexpr double golden = 0.6180339887498949;
  const auto wrapped = [](long v) { return static_cast<std::size_t>(v & static_cast<long>(side - 1)); };
  std::vector<bool> out(cells.wanted.size(), false);
  for (std::size_t j = 0; j < cells.rows; ++j)
    for (std::size_t i = 0; i < cells.columns; ++i) {
      const std::size_t n = j * cells.columns + i;
      const double moved =
          tile[wrapped(first_row + static_cast<long>(j)) * side + wrapped(first_column + static_cast<long>(i))] +
          golden * static_cast<double>(layer);
      const double room = cells.high[n] - cells.low[n];
      out[n] = room > 0 && (cells.wanted[n] - cells.low[n]) / room > moved - std::floor(moved);
    }
  return out;
}

}  // namespace weft::infill
