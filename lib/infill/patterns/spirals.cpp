// SPDX-License-Identifier: GPL-3.0-or-later
// Spirals about the point where the pattern is anchored.
#include "infill/pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace weft::infill {
namespace {

/// Distance of the farthest corner of the area.
double farthest(const Span2& area) {
  return std::hypot(std::max(std::abs(area.min.x), std::abs(area.max.x)),
                    std::max(std::abs(area.min.y), std::abs(area.max.y)));
}

}  // namespace

Drawing draw_archimedean(const PatternPlace& p) {
  constexpr double off = 5;  // µm that a chord may stand off
  const double s = p.spacing(), end = farthest(p.area) + s, per_radian = s / (2 * std::numbers::pi);
  Drawing out{.pitch = s};
  Curve& curve = out.curves.emplace_back();
  for (double angle = 0; per_radian * angle < end;) {
    const double r = per_radian * angle;
    curve.points.push_back({r * std::cos(angle), r * std::sin(angle)});
    angle += std::min(0.5, 2 * std::acos(std::max(0.5, 1 - off / std::max(r, per_radian))));
  }
  return out;
}

/// Each turn is a star of two squares; turns widen where they cross the axis.
Drawing draw_octagram(const PatternPlace& p) {
  const double s = p.spacing(), end = std::numbers::sqrt2 * farthest(p.area) + s;
  Drawing out{.pitch = s};
  Curve& curve = out.curves.emplace_back();
  for (double r = s / 2; r < end; r += std::numbers::sqrt2 * s) {
    const double q = r / std::numbers::sqrt2;
    double c = 1, d = 0;  // cosine and sine of whole quarters
    for (int quarter = 0; quarter < 4; ++quarter) {
      for (const Turned t : {Turned{r, 0}, Turned{r + q, q}, Turned{q, q}, Turned{q, r + q}})
        curve.points.push_back({t.x * c - t.y * d, t.x * d + t.y * c});
      c = std::exchange(d, c), c = -c;
    }
  }
  return out;
}

}  // namespace weft::infill
