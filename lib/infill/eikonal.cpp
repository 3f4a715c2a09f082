// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/eikonal.h"

#include <algorithm>
#include <cmath>

namespace weft::infill {
namespace {

constexpr int most_rounds = 8;    // of four sweeps; one does where the front turns nowhere
constexpr double settled = 1e-3;  // of the distance of two lines

/// The smallest u that its smaller neighbours along both axes allow. @param cost of the way from node to node
double arrival(double a, double b, double cost) {
  if (std::abs(a - b) >= cost) return std::min(a, b) + cost;
  return (a + b + std::sqrt(2 * cost * cost - (a - b) * (a - b))) / 2;
}

}  // namespace

void sweep_front(const LevelGrid& grid, const std::vector<double>& slowness, std::vector<double>& u) {
  const std::size_t columns = grid.columns, rows = grid.rows;
  std::vector<char> open(u.size());
  for (std::size_t n = 0; n < u.size(); ++n) open[n] = u[n] >= unreached;
  const auto reached = [&](std::size_t n) { return u[n] < 0 ? unreached : u[n]; };
  double change = 0;
  const auto look_at = [&](std::size_t i, std::size_t j) {
    const std::size_t n = j * columns + i;
    if (!open[n]) return;
    const double a = std::min(i > 0 ? reached(n - 1) : unreached, i + 1 < columns ? reached(n + 1) : unreached),
                 b = std::min(j > 0 ? reached(n - columns) : unreached,
                              j + 1 < rows ? reached(n + columns) : unreached);
    if (std::min(a, b) >= unreached) return;
    const double found = arrival(a, b, slowness[n] * grid.step);
    if (found >= u[n]) return;
    change = std::max(change, u[n] - found);
    u[n] = found;
  };
  const auto sweep = [&](bool right, bool up) {
    for (std::size_t y = 0; y < rows; ++y)
      for (std::size_t x = 0; x < columns; ++x) look_at(right ? x : columns - 1 - x, up ? y : rows - 1 - y);
  };
  for (int round = 0; round < most_rounds; ++round) {
    stop_if_asked();
    change = 0;
    for (const bool up : {true, false})
      for (const bool right : {true, false}) sweep(right, up);
    if (change < settled) return;
  }
}

}  // namespace weft::infill
