// SPDX-License-Identifier: GPL-3.0-or-later
// Triply periodic minimal surfaces, cut at a height: the curves where a sum of products of sines is zero.
#include "infill/gyroid.h"
#include "infill/level_set.h"
#include "infill/repeated_curves.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::infill {
namespace {

constexpr double turn = 2 * std::numbers::pi;

/// Sines and cosines of one coordinate.
struct Wave {
  double s = 0, c = 0, c2 = 0;
};
Wave wave(double t) {
  return {std::sin(t), std::cos(t), std::cos(2 * t)};
}

/// Of coordinates one after the other.
struct Waves {
  std::vector<double> s, c, c2;
  void add(const Wave& w) { s.push_back(w.s), c.push_back(w.c), c2.push_back(w.c2); }
  Wave operator[](std::size_t i) const { return {s[i], c[i], c2[i]}; }
};

struct Diamond {
  /// cos(x + y) cos(z − π/4) + cos(x − y) cos(z + π/4), by the sums of angles, less the common root of a half
  static double value(const Wave& x, const Wave& y, const Wave& z) {
    const double sum = x.c * y.c - x.s * y.s, difference = x.c * y.c + x.s * y.s;
    return sum * (z.c + z.s) + difference * (z.c - z.s);
  }
};
struct FischerKoch {
  static double value(const Wave& x, const Wave& y, const Wave& z) {
    return x.c2 * y.s * z.c + y.c2 * z.s * x.c + z.c2 * x.s * y.c;
  }
};
struct SchwarzP {
  static double value(const Wave& x, const Wave& y, const Wave& z) { return x.c + y.c + z.c; }
};

/// Of a surface, cut at a height, on a grid; where it repeats, waves along an axis are those of the first period.
template <class Surface>
std::vector<Curve> trace(const LevelGrid& grid, double unit, const Wave& z, std::size_t repeats) {
  Waves across;
  for (std::size_t i = 0; i < grid.columns; ++i) across.add(wave(grid.x(i % repeats) / unit));
  std::vector<double> values(grid.columns * grid.rows);
  for (std::size_t j = 0; j < grid.rows; ++j) {
    stop_if_asked();
    const Wave y = wave(grid.y(j % repeats) / unit);
    double* row = &values[j * grid.columns];
    for (std::size_t i = 0; i < grid.columns; ++i) row[i] = Surface::value(across[i], y, z);
  }
  return zero_curves(grid, values);
}

/// @param period of the surface along each axis, in distances of lines
template <class Surface>
Drawing cut_at(const PatternPlace& p, double period) {
  const double length = period * p.spacing(), unit = length / turn;
  // chords of a curve with a radius of a sixth of the period stand off by 4 µm at most
  constexpr double off = 4;
  const double steps = std::clamp(std::ceil(std::sqrt(6 * length / (8 * off))), 16.0, 96.0);
  const LevelGrid whole(p.area, length / steps);
  const Wave z = wave(p.z / unit);
  Drawing out{.pitch = length / 2};
  const auto nodes = static_cast<std::size_t>(steps);
  const auto around = [&](double x, double y, double d) {
    const Wave wx = wave(x / unit), wy = wave(y / unit);
    return ValuesAround{Surface::value(wx, wy, z), Surface::value(wave((x + d) / unit), wy, z),
                        Surface::value(wx, wave((y + d) / unit), z)};
  };
  if (whole.columns * whole.rows > 2 * nodes * nodes) {
    LevelGrid first = whole;
    first.min = {}, first.columns = first.rows = nodes + 1;
    if (auto curves = join_over_borders(first, trace<Surface>(first, unit, z, nodes))) {
      mend_zero_curves(around, first.step, *curves);
      out.curves = repeat(*curves, length, p.area);
      return out;
    }
  }
  out.curves = trace<Surface>(whole, unit, z, whole.columns + whole.rows);
  mend_zero_curves(around, whole.step, out.curves);
  return out;
}

}  // namespace

Drawing draw_gyroid(const PatternPlace& p) {
  const double period = gyroid_period(p.band, p.density);
  Drawing out{.pitch = period / 2};
  for (std::vector<Turned>& curve : gyroid_curves(p.area, period, p.z)) out.curves.push_back({std::move(curve), false});
  return out;
}

// Periods: the length of the curves in a cell, over all heights, integrated numerically.
Drawing draw_diamond(const PatternPlace& p) {
  return cut_at<Diamond>(p, 3.045);
}
Drawing draw_fischer_koch(const PatternPlace& p) {
  return cut_at<FischerKoch>(p, 4.276);
}
Drawing draw_schwarz_p(const PatternPlace& p) {
  return cut_at<SchwarzP>(p, 1.886);
}

}  // namespace weft::infill
