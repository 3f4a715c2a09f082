// SPDX-License-Identifier: GPL-3.0-or-later
// Patterns of parallel lines. A family of pitch s holds the share b/s of the plane.
#include "infill/pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::infill {
namespace {

constexpr double quarter = 0.5 * std::numbers::pi;
constexpr double third = 1.0 / 3 * std::numbers::pi, thirds = 2.0 / 3 * std::numbers::pi;

/// What is left of v after whole periods, 0 … period.
double within(double v, double period) {
  return v - period * std::floor(v / period);
}

/// Lines at ±c in each period, c sliding from 0 to half a period and back with the height. Where two would lie on each
/// other they lie side by side instead.
void add_pairs(double angle_rad, double slide, double period, double band, Drawing& to) {
  const double folded = within(slide, period);
  const double c = std::clamp(std::min(folded, period - folded), band / 2, std::max(band / 2, period / 2 - band / 2));
  to.families.push_back({angle_rad, period, c});
  to.families.push_back({angle_rad, period, -c});
}

}  // namespace

Drawing draw_lines(const PatternPlace& p) {
  return {.families = {{0, p.spacing(), 0}}, .pitch = p.spacing()};
}

Drawing draw_grid(const PatternPlace& p) {
  const double s = 2 * p.spacing();
  return {.families = {{0, s, 0}, {quarter, s, 0}}, .pitch = s};
}

Drawing draw_triangles(const PatternPlace& p) {
  const double s = 3 * p.spacing();
  return {.families = {{0, s, 0}, {third, s, 0}, {thirds, s, 0}}, .pitch = s};
}

/// Every second line runs from beside one of its neighbours to beside the other, across the whole object.
Drawing draw_slanted(const PatternPlace& p) {
  const double s = p.spacing(), swing = std::max(0.0, s - p.band), half = 1.5 * p.reach + s;
  Drawing out{.families = {{0, 2 * s, 0}}, .pitch = s};
  const auto first = static_cast<long>(std::floor((p.area.min.y - s) / (2 * s))) - 1;
  const auto last = static_cast<long>(std::ceil((p.area.max.y + s) / (2 * s))) + 1;
  for (long k = first; k <= last; ++k) {
    const double y = (2 * static_cast<double>(k) + 1) * s;
    out.curves.push_back({{{-half, y - swing}, {half, y + swing}}, false});
  }
  return out;
}

Drawing draw_crosszag(const PatternPlace& p) {
  constexpr double step = 400;  // µm a layer, less than a line is wide
  return {.families = {{0, p.spacing(), within(step * static_cast<double>(p.index), p.spacing())}},
          .pitch = p.spacing()};
}

Drawing draw_trihexagon(const PatternPlace& p) {
  const double s = 3 * p.spacing();
  return {.families = {{0, s, 0}, {third, s, 0}, {thirds, s, s / 2}}, .pitch = s};
}

/// Three sets of planes, square to each other, that stand on their corner.
Drawing draw_cubic(const PatternPlace& p) {
  const double s = 3 * p.spacing(), c = within(p.z / std::numbers::sqrt2, s);
  return {.families = {{0, s, c}, {thirds, s, c}, {2 * thirds, s, c}}, .pitch = s};
}

Drawing draw_tetrahedral(const PatternPlace& p) {
  Drawing out{.pitch = 2 * p.spacing()};
  for (const double angle : {0.0, quarter}) add_pairs(angle, p.z / std::numbers::sqrt2, 4 * p.spacing(), p.band, out);
  return out;
}

Drawing draw_quarter_cubic(const PatternPlace& p) {
  const double period = 4 * p.spacing();
  Drawing out{.pitch = period / 2};
  add_pairs(0, p.z / std::numbers::sqrt2, period, p.band, out);
  add_pairs(quarter, p.z / std::numbers::sqrt2 + period / 4, period, p.band, out);
  return out;
}

Drawing draw_lateral_lattice(const PatternPlace& p) {
  Drawing out{.pitch = 2 * p.spacing()};
  add_pairs(0, p.z, 2 * p.spacing(), p.band, out);
  return out;
}

/// Hexagons that stand on a corner, seen along the lines: of a period two thirds are single walls, one third is pairs
/// that part from one wall and meet at the next.
Drawing draw_lateral_honeycomb(const PatternPlace& p) {
  const double w = 2 * p.spacing() / 3, period = 3 * w / std::numbers::sqrt3;
  const double whole = std::floor(p.z / period), t = p.z / period - whole;
  const double here = static_cast<long>(whole) % 2 == 0 ? 0 : w;
  Drawing out{.pitch = 2 * w, .longer = 1};  // it has the density over the height, not at each
  constexpr double upright = 2.0 / 3;
  if (t < upright) {
    out.families.push_back({0, 2 * w, here});
    return out;
  }
  const double c = std::clamp(w * (t - upright) / (1 - upright), p.band / 2, std::max(p.band / 2, w - p.band / 2));
  out.families.push_back({0, 2 * w, here + c});
  out.families.push_back({0, 2 * w, here - c});
  return out;
}

}  // namespace weft::infill
