// SPDX-License-Identifier: GPL-3.0-or-later
#include "field/grid.h"

#include <algorithm>
#include <cmath>

namespace weft::field {

double Grid::at(double x, double y, double z) const {
  struct Between {
    std::size_t node;
    double share;  // of the way to the next
  };
  const auto between = [](double v, std::size_t count) {
    const double t = std::clamp(v, 0.0, static_cast<double>(count) - 1);
    const std::size_t i = std::min(static_cast<std::size_t>(t), count > 1 ? count - 2 : 0);
    return Between{i, t - static_cast<double>(i)};
  };
  const auto u = between((x - x0) / dx, columns), v = between((y - y0) / dy, rows), w = between((z - z0) / dz, slices);
  const auto value = [&](std::size_t a, std::size_t b, std::size_t c) {
    return static_cast<double>(
        values[(std::min(c, slices - 1) * rows + std::min(b, rows - 1)) * columns + std::min(a, columns - 1)]);
  };
  const auto row = [&](std::size_t b, std::size_t c) {
    return std::lerp(value(u.node, b, c), value(u.node + 1, b, c), u.share);
  };
  const auto sheet = [&](std::size_t c) { return std::lerp(row(v.node, c), row(v.node + 1, c), v.share); };
  return std::lerp(sheet(w.node), sheet(w.node + 1), w.share);
}

std::optional<double> TensorGrid::direction_at(double x, double y, double z) const {
  const double across = xx.at(x, y, z) - yy.at(x, y, z), shear = xy.at(x, y, z),
               size = std::abs(xx.at(x, y, z)) + std::abs(yy.at(x, y, z)) + std::abs(shear);
  constexpr double alike = 1e-6;  // of their size
  if (!(std::hypot(across, 2 * shear) > alike * size)) return std::nullopt;
  return std::atan2(2 * shear, across) / 2;
}

}  // namespace weft::field
