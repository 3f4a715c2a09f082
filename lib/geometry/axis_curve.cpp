// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/axis_curve.h"

#include <algorithm>
#include <cmath>

namespace weft::geometry {
namespace {

/// A curved edge of the axis: the point at angle θ, seen from the focus (a corner), off the shortest way to the other
/// site. Parabola with focus F, distance h to the line: x = h tan(θ/2), clearance (x² + h²) / 2h. Bisector of two
/// corners 2c apart: x = c tan θ, clearance c / cos θ.
struct Curve {
  Place origin;   ///< on the line, or half-way between the corners: x = 0
  double ux, uy;  ///< direction of x
  double vx, vy;  ///< towards the axis from the origin (parabola)
  double h;       ///< distance of focus and line, or half that of the corners
  bool parabola;
  double x_of(Place p) const { return (p.x - origin.x) * ux + (p.y - origin.y) * uy; }
  double angle_of(double x) const { return parabola ? 2 * std::atan(x / h) : std::atan(x / h); }
  double x_at(double angle) const { return parabola ? h * std::tan(angle / 2) : h * std::tan(angle); }
  MedialAxis::Node at(double x) const {
    if (!parabola) return {{origin.x + x * ux, origin.y + x * uy}, std::sqrt(x * x + h * h)};
    const double r = (x * x + h * h) / (2 * h);
    return {{origin.x + x * ux + r * vx, origin.y + x * uy + r * vy}, r};
  }
};

Curve curve_of(const MedialAxis::Site& s, const MedialAxis::Site& t) {
  if (s.corner && t.corner) {
    const double d = distance(s.a, t.a);
    const double nx = (t.a.x - s.a.x) / d, ny = (t.a.y - s.a.y) / d;
    return {lerp(s.a, t.a, 0.5), -ny, nx, 0, 0, d / 2, false};
  }
  const auto &line = s.corner ? t : s, &corner = s.corner ? s : t;
  const double ux0 = line.b.x - line.a.x, uy0 = line.b.y - line.a.y, length = distance(line.a, line.b);
  const double ux = ux0 / length, uy = uy0 / length;
  const double along = (corner.a.x - line.a.x) * ux + (corner.a.y - line.a.y) * uy;
  const double h = (corner.a.y - line.a.y) * ux - (corner.a.x - line.a.x) * uy;
  const double side = h < 0 ? -1 : 1;
  return {{line.a.x + along * ux, line.a.y + along * uy}, ux, uy, -uy * side, ux * side, std::abs(h), true};
}

}  // namespace

Place foot_on(const MedialAxis::Site& site, Place p) {
  if (site.corner) return site.a;
  const double ux = site.b.x - site.a.x, uy = site.b.y - site.a.y;
  const double t = ((p.x - site.a.x) * ux + (p.y - site.a.y) * uy) / (ux * ux + uy * uy);
  return lerp(site.a, site.b, std::clamp(t, 0.0, 1.0));
}

void add_nodes_between(const MedialAxis& axis, std::uint32_t half_edge, double chord, double reach,
                       std::vector<MedialAxis::Node>& out) {
  const auto& forward = axis.half_edges[half_edge];
  const auto& backward = axis.half_edges[MedialAxis::twin(half_edge)];
  const auto &s = axis.sites[forward.site], &t = axis.sites[backward.site];
  if (!s.corner && !t.corner) return;
  const auto &a = axis.nodes[forward.from], &b = axis.nodes[backward.from];
  if (distance(a.at, b.at) < 2) return;
  const Curve curve = curve_of(s, t);
  if (!(curve.h > 0.5)) return;
  const double from = curve.angle_of(curve.x_of(a.at)), to = curve.angle_of(curve.x_of(b.at));
  const double widest = std::clamp(std::max(a.clearance, b.clearance), 1.0, std::max(1.0, reach));
  const double step = 2 * std::sqrt(2 * chord / std::max(widest, 4 * chord));
  auto run = [&](double x, double y) {
    const int pieces = std::clamp(static_cast<int>(std::ceil(std::abs(y - x) / step)), 1, 200);
    for (int i = 1; i < pieces; ++i) out.push_back(curve.at(curve.x_at(x + (y - x) * i / pieces)));
  };
  if (from * to < 0 && std::min(std::abs(from), std::abs(to)) > 1e-3) {  // the narrowest place is a node
    run(from, 0);
    out.push_back(curve.at(0));
    run(0, to);
  } else {
    run(from, to);
  }
}

}  // namespace weft::geometry
