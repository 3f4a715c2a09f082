// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/multiply.h"

#include <algorithm>
#include <cmath>

namespace weft::infill {
namespace {

/// The curve moved to its left by a distance; at sharp corners no farther than three times that.
Curve beside(const Curve& curve, double by) {
  const std::vector<Turned>& p = curve.points;
  const std::size_t n = p.size();
  const auto normal = [&](std::size_t i) {  // of the step from point i
    const Turned a = p[i], b = p[(i + 1) % n];
    const double dx = b.x - a.x, dy = b.y - a.y, way = std::max(std::hypot(dx, dy), 1e-9);
    return Turned{-dy / way, dx / way};
  };
  Curve out{{}, curve.closed};
  out.points.reserve(n);
  for (std::size_t i = 0; i < n; ++i) {
    const bool first = i == 0 && !curve.closed, last = i + 1 == n && !curve.closed;
    const Turned after = normal(last ? i - 1 : i), before = first ? after : normal((i + n - 1) % n);
    const double bend = std::max(1 + before.x * after.x + before.y * after.y, 1.0 / 3);
    out.points.push_back({p[i].x + by / bend * (before.x + after.x), p[i].y + by / bend * (before.y + after.y)});
  }
  return out;
}

}  // namespace

void multiply(Drawing& drawing, int times, double band_um) {
  if (times <= 1) return;
  const auto offset = [&](int k) { return (k - (times - 1) / 2.0) * band_um; };
  std::vector<Family> families;
  for (const Family& family : drawing.families)
    for (int k = 0; k < times; ++k) families.push_back({family.angle_rad, family.pitch, family.phase + offset(k)});
  std::vector<Curve> curves;
  for (const Curve& curve : drawing.curves)
    if (curve.points.size() > 1)
      for (int k = 0; k < times; ++k) curves.push_back(beside(curve, offset(k)));
  drawing.families = std::move(families), drawing.curves = std::move(curves);
}

}  // namespace weft::infill
