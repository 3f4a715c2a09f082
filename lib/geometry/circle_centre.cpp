// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/circle_centre.h"

#include <algorithm>
#include <cmath>

namespace weft::geometry::detail {
namespace {

/// Cosine of an angle to a line that is as good as at right angles to it: a quotient by it would be off by as much
/// more.
constexpr double least_slant = 1e-4;
/// Distance from a line that may be rounding, µm: coordinates are below 2²⁴ µm, and of them 2⁻⁵³ a few times.
constexpr double on_line_um = 1e-6;

/// An edge's line, by a point and a unit vector.
struct Line {
  double x, y, ux, uy;
  explicit Line(const GraphSite& s) : x(s.ax), y(s.ay), ux(s.bx - s.ax), uy(s.by - s.ay) {
    const double length = std::sqrt(ux * ux + uy * uy);
    ux /= length, uy /= length;
  }
  /// Distance of a place, positive on the left.
  double height(double px, double py) const { return ux * (py - y) - uy * (px - x); }
};

/// At an end p of an edge the circle's centre lies on the perpendicular: at p + t n, with n to the left of the way into
/// the edge, t > 0 where the edge comes after its end.
struct Perpendicular {
  double x, y, nx, ny;
  Perpendicular(const GraphSite& p, const GraphSite& edge) : x(p.ax), y(p.ay) {
    const Line line(edge);
    const double sense = edge.a == p.a ? 1.0 : -1.0;
    nx = -sense * line.uy, ny = sense * line.ux;
  }
  Centre at(double t) const { return {x + t * nx, y + t * ny}; }
};

Centre of_points(const GraphSite& a, const GraphSite& b, const GraphSite& c) {
  const double bx = b.ax - a.ax, by = b.ay - a.ay, cx = c.ax - a.ax, cy = c.ay - a.ay;
  const double b2 = bx * bx + by * by, c2 = cx * cx + cy * cy, twice = 2 * (bx * cy - by * cx);
  return {a.ax + (cy * b2 - by * c2) / twice, a.ay + (bx * c2 - cx * b2) / twice};
}

Centre on_perpendicular(const Perpendicular& from, const GraphSite& point) {
  const double dx = point.ax - from.x, dy = point.ay - from.y;
  return from.at((dx * dx + dy * dy) / (2 * (dx * from.nx + dy * from.ny)));
}

/// @param sense  1 or -1: the sign of t
Centre on_perpendicular(const Perpendicular& from, const Line& line, double sense) {
  const double height = line.height(from.x, from.y), slant = from.ny * line.ux - from.nx * line.uy;
  // height + t slant is t, or −t
  return from.at((height > 0) == (sense > 0) ? height / (1 - slant) : -height / (1 + slant));
}

/// Two points and an edge that ends in neither. With p as origin, x along the line, y away from it and h the points'
/// heights: x² + y² = (y + hₚ)², and (x, y) is as far from q.
std::optional<Centre> of_points_and_edge(const GraphSite& p, const GraphSite& q, const GraphSite& edge) {
  const Line line(edge);
  const double height_p = line.height(p.ax, p.ay), height_q = line.height(q.ax, q.ay);
  if (!(height_p * height_q > 0)) return std::nullopt;
  const bool swapped = std::abs(height_q) > std::abs(height_p);  // the farther point is the origin
  const GraphSite &o = swapped ? q : p, &other = swapped ? p : q;
  const double sense = height_p > 0 ? 1.0 : -1.0;
  const double h = sense * (swapped ? height_q : height_p), other_h = sense * (swapped ? height_p : height_q);
  const double dx = (other.ax - o.ax) * line.ux + (other.ay - o.ay) * line.uy, dy = other_h - h, d2 = dx * dx + dy * dy;
  // dy x² + 2 h dx x − h (dy h + d²) = 0; the sign of the root is that of the order of the three around the circle
  const double half = h * dx, root = (swapped ? sense : -sense) * std::sqrt(h * other_h * d2);
  const double x = (root > 0) == (half < 0) ? (root - half) / dy : h * (dy * h + d2) / (half + root);
  const double y = (x * x - h * h) / (2 * h);
  return Centre{o.ax + x * line.ux - y * sense * line.uy, o.ay + x * line.uy + y * sense * line.ux};
}

/// A point and two edges that do not end in it. With p as origin, x along the first line and y away from it, m the
/// second line's unit vector away from it, and h the heights over the lines:
/// x² + y² = r², y + h₁ = r, m·(x, y) + h₂ = r.
std::optional<Centre> of_point_and_edges(const GraphSite& p, const GraphSite& first, const GraphSite& second) {
  const Line a(first), b(second);
  double h1 = a.height(p.ax, p.ay), h2 = b.height(p.ax, p.ay);
  const double s1 = h1 > 0 ? 1.0 : -1.0, s2 = h2 > 0 ? 1.0 : -1.0;
  h1 *= s1, h2 *= s2;
  const double bx = -s2 * b.uy, by = s2 * b.ux;
  const double mx = bx * a.ux + by * a.uy, my = s1 * (by * a.ux - bx * a.uy);
  if (std::abs(mx) < least_slant) return std::nullopt;
  // (1 − m.y) r = h₁ + h₂ ± √(2 h₁ h₂ (1 + m.y))
  const double sum = h1 + h2 + std::sqrt(2 * h1 * h2 * std::max(0.0, 1 + my));
  const double radii[2] = {(h1 * h1 + h2 * h2 - 2 * my * h1 * h2) / ((1 - my) * sum), sum / (1 - my)};
  for (const double r : radii) {
    const double y = r - h1, x = (r - h2 - my * y) / mx;
    // from p to where the circle touches the lines: counter-clockwise
    if (s1 * (x * (y - r * my) + h1 * (x - r * mx)) > 0)
      return Centre{p.ax + x * a.ux - y * s1 * a.uy, p.ay + x * a.uy + y * s1 * a.ux};
  }
  return std::nullopt;
}

/// The side of an edge on which another lies, 1 or -1; 0 where it is on both, or along its line.
double side_of(const GraphSite& edge, const Line& line, const GraphSite& other) {
  const double a = edge.ends_in(other.a) ? 0.0 : line.height(other.ax, other.ay),
               b = edge.ends_in(other.b) ? 0.0 : line.height(other.bx, other.by);
  if (std::max(std::abs(a), std::abs(b)) < on_line_um || a * b < 0) return 0.0;
  return a + b > 0 ? 1.0 : -1.0;
}

/// Three edges: m·(x, y) + h = r of each, with m the unit vector away from its line, to where the circle is.
std::optional<Centre> of_edges(const GraphSite* const (&sites)[3]) {
  const double ox = sites[0]->ax, oy = sites[0]->ay;
  double mx[3], my[3], h[3];
  for (int i = 0; i < 3; ++i) {
    const Line line(*sites[i]);
    double side = side_of(*sites[i], line, *sites[(i + 1) % 3]);
    if (side == 0) side = side_of(*sites[i], line, *sites[(i + 2) % 3]);
    if (side == 0) return std::nullopt;
    mx[i] = -side * line.uy, my[i] = side * line.ux, h[i] = side * line.height(ox, oy);
  }
  const double ax = mx[0] - mx[1], ay = my[0] - my[1], bx = mx[0] - mx[2], by = my[0] - my[2];
  const double a = h[1] - h[0], b = h[2] - h[0], turn = ax * by - ay * bx;
  return Centre{ox + (a * by - b * ay) / turn, oy + (ax * b - bx * a) / turn};
}

}  // namespace

std::optional<Centre> circle_centre(const GraphSite& a, const GraphSite& b, const GraphSite& c) {
  const GraphSite* s[3] = {&a, &b, &c};
  const int edges = a.edge + b.edge + c.edge;
  if (edges == 0) return of_points(a, b, c);
  if (edges == 3) return of_edges(s);
  // turned so that a lone edge is the last, a lone point the first
  while (edges == 1 ? !s[2]->edge : s[0]->edge) std::rotate(s, s + 1, s + 3);
  if (edges == 1) {
    const bool from_p = s[2]->ends_in(s[0]->a), from_q = s[2]->ends_in(s[1]->a);
    if (from_p && from_q) return std::nullopt;
    if (from_p) return on_perpendicular(Perpendicular(*s[0], *s[2]), *s[1]);
    if (from_q) return on_perpendicular(Perpendicular(*s[1], *s[2]), *s[0]);
    return of_points_and_edge(*s[0], *s[1], *s[2]);
  }
  const bool first = s[1]->ends_in(s[0]->a), second = s[2]->ends_in(s[0]->a);
  if (first && second) return Centre{s[0]->ax, s[0]->ay};
  if (first) return on_perpendicular(Perpendicular(*s[0], *s[1]), Line(*s[2]), 1.0);
  if (second) return on_perpendicular(Perpendicular(*s[0], *s[2]), Line(*s[1]), -1.0);
  return of_point_and_edges(*s[0], *s[1], *s[2]);
}

}  // namespace weft::geometry::detail
