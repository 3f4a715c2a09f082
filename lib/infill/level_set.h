// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/stop.h"
#include "infill/pattern.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace weft::infill {

/// Where a function of the plane is zero, on a grid: nodes min + (i, j)·step, 0 ≤ i < columns, 0 ≤ j < rows.
struct LevelGrid {
  Turned min;
  double step = 1;
  std::size_t columns = 0, rows = 0;

  /// Around the area, at least a step beyond it on each side; nodes are at multiples of the step.
  LevelGrid(const Span2& area, double step_um)
      : min{step_um * (std::floor(area.min.x / step_um) - 1), step_um * (std::floor(area.min.y / step_um) - 1)},
        step(step_um),
        columns(static_cast<std::size_t>(std::ceil((area.max.x - min.x) / step_um)) + 2),
        rows(static_cast<std::size_t>(std::ceil((area.max.y - min.y) / step_um)) + 2) {}
  double x(std::size_t i) const { return min.x + static_cast<double>(i) * step; }
  double y(std::size_t j) const { return min.y + static_cast<double>(j) * step; }
};

/// The curves between positive and other values, the positive side on their left. Where four corners of a cell
/// alternate, the mean of them decides. Curves end at the border of the grid or are closed.
/// @param values by row, then by column
/// Source: Lorensen & Cline 1987, "Marching cubes", in the plane. Cost: O(nodes), about 10 ns each.
std::vector<Curve> zero_curves(const LevelGrid& grid, const std::vector<double>& values);

/// What a function is at a place, and a little beside it along either axis.
struct ValuesAround {
  double here = 0, along_x = 0, along_y = 0;
};

/// Each place of the curves is mended by one secant step with the function itself.
/// @param around  around(x, y, d): at x, y, and d beside it; fractional microns
template <class Around, class Traced>
void mend_zero_curves(const Around& around, double step, std::vector<Traced>& curves) {
  const double d = step * 1e-3;
  for (Traced& curve : curves) {
    stop_if_asked();
    for (Turned& p : curve.points) {
      const ValuesAround f = around(p.x, p.y, d);
      const double v = f.here, gx = (f.along_x - v) / d, gy = (f.along_y - v) / d;
      const double g2 = gx * gx + gy * gy;
      if (g2 <= 0) continue;
      const double by = v / g2;
      if (std::abs(by) * std::sqrt(g2) > step / 4) continue;  // near a place where it is flat
      p.x -= by * gx, p.y -= by * gy;
    }
  }
}

}  // namespace weft::infill
