// SPDX-License-Identifier: GPL-3.0-or-later
// Patterns of waves with straight flanks: cells whose walls are shared by neighbouring waves.
#include "infill/pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::infill {
namespace {

using std::numbers::sqrt2;
using std::numbers::sqrt3;

/// A wave's corners in one period along its axis: place along, and across from its own line.
using Corners = std::vector<Turned>;

/// Waves over the area. @param along_y  their axis is y, else x
/// @param apart  of their lines; @param corners_of  those of the wave with that number, places 0 … period ascending
template <class CornersOf>
void add_waves(const Span2& area, bool along_y, double apart, double period, double swing, double shift_along,
               double shift_across, const CornersOf& corners_of, Drawing& to) {
  const auto along = [&](Turned t) { return along_y ? t.y : t.x; };
  const auto across = [&](Turned t) { return along_y ? t.x : t.y; };
  const auto first = static_cast<long>(std::floor((across(area.min) - swing - shift_across) / apart)),
             last = static_cast<long>(std::ceil((across(area.max) + swing - shift_across) / apart));
  const auto from = static_cast<long>(std::floor((along(area.min) - shift_along) / period)) - 1,
             until = static_cast<long>(std::ceil((along(area.max) - shift_along) / period)) + 1;
  for (long k = first; k <= last; ++k) {
    const Corners corners = corners_of(k);
    Curve& curve = to.curves.emplace_back();
    curve.points.reserve(static_cast<std::size_t>(until - from) * corners.size());
    for (long i = from; i < until; ++i)
      for (const Turned c : corners) {
        const double a = static_cast<double>(i) * period + c.x + shift_along,
                     b = static_cast<double>(k) * apart + c.y + shift_across;
        curve.points.push_back(along_y ? Turned{b, a} : Turned{a, b});
      }
  }
}

/// A trapezoid between ±o/2 whose flanks lean by 45°, period 2d, the way that wave k has it: neighbours are mirrored.
Corners trapezoid(long k, double d, double o) {
  const double side = (k % 2 == 0 ? 0.5 : -0.5) * o, a = std::abs(o);
  return {{a / 2, side}, {d - a / 2, side}, {d + a / 2, -side}, {2 * d - a / 2, -side}};
}

}  // namespace

/// Hexagons of side a in columns; walls between two columns are drawn twice, side by side. Each layer is turned by 60°
/// about the middle of a cell, so that double walls stand on single ones.
Drawing draw_honeycomb(const PatternPlace& p) {
  const double b = p.band, a = b * (1 + std::sqrt(std::max(0.0, 1 - 0.75 * p.density))) / (1.299 * p.density);
  const double column = a * sqrt3 / 2, rise = a / 2 - b / sqrt3, upright = (3 * a - 2 * rise) / 2;
  Drawing out{.pitch = column};
  const auto corners = [&](long k) -> Corners {
    const double left = b / 2, right = column - b / 2;
    const bool even = k % 2 == 0;  // its upright walls around 0 are at the left
    const double l = even ? left : right, r = even ? right : left;
    return {{0, l},
            {upright / 2, l},
            {upright / 2 + rise, r},
            {upright / 2 + rise + upright, r},
            {upright / 2 + 2 * rise + upright, l}};
  };
  add_waves(p.area, true, column, 3 * a, column, 0, -column, corners, out);
  return out;
}

/// Octagons of side l and what is left between four of them.
Drawing draw_octagon(const PatternPlace& p) {
  const double l = 4 * p.spacing() / (2 + sqrt2) / (1 + sqrt2 / 2), lean = l / sqrt2;
  Drawing out{.pitch = l * (1 + sqrt2 / 2)};
  const auto corners = [&](long k) -> Corners {
    const double side = k % 2 == 0 ? lean / 2 : -lean / 2;
    return {{0, side}, {l, side}, {l + lean, -side}, {2 * l + lean, -side}};
  };
  add_waves(p.area, true, out.pitch, 2 * l + 2 * lean, lean, 0, 0, corners, out);
  return out;
}

/// Truncated octahedra, which fill space; the walls between them, cut at a height.
Drawing draw_honeycomb_3d(const PatternPlace& p) {
  const double d = (3 + sqrt2) / 4 * p.spacing(), period = sqrt2 * d;
  const double t = p.z / period - std::floor(p.z / period);
  const bool rows = t < 0.5;
  const double o = (rows ? 2 * t - 0.5 : 1.5 - 2 * t) * d;
  Drawing out{.pitch = d};
  // columns take over the flanks of the rows where both have their full swing
  const double shift = rows ? 0 : d / 2;
  add_waves(
      p.area, !rows, d, 2 * d, d / 2, shift, shift, [&](long k) { return trapezoid(rows ? k : k + 1, d, o); }, out);
  return out;
}

/// Straight walls that bend into the walls of truncated octahedra, go over to the other direction there, and
/// straighten.
Drawing draw_crosshatch(const PatternPlace& p) {
  constexpr double straight = 0.4, bend = 0.2;                               // of the distance of lines, in height
  const double longer = 1 + bend * (sqrt2 - 1) / 4 / (straight / 2 + bend);  // lines, on average over the height
  const double s = longer * p.spacing(), half = (straight + 2 * bend) * s;
  const double turns = p.z / half - std::floor(p.z / half / 2) * 2;
  const bool rows = turns < 1;
  const double t = (turns - std::floor(turns)) * (straight + 2 * bend);  // bends back, stands straight, bends away
  const double swing = t < bend ? -(1 - t / bend) : t > bend + straight ? (t - bend - straight) / bend : 0;
  const double o = (rows ? swing : -swing) * s / 2, shift = rows ? 0 : s / 2;
  Drawing out{.pitch = s};
  add_waves(
      p.area, !rows, s, 2 * s, s / 2, shift, shift, [&](long k) { return trapezoid(rows ? k : k + 1, s, o); }, out);
  return out;
}

}  // namespace weft::infill
