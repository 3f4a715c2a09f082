// SPDX-License-Identifier: GPL-3.0-or-later
// Closed curves through right triangles: a square is bisected again and again, each triangle is passed once, and the
// curve crosses the edge between each two that follow each other.
#include "infill/pattern.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::infill {
namespace {

/// A right triangle between its two sharp corners; the right angle is at `top`.
struct Triangle {
  Turned from, top, to;
};
Turned middle(Turned a, Turned b) {
  return {(a.x + b.x) / 2, (a.y + b.y) / 2};
}

/// Triangles near the area, in the curve's order; where some are left out a new run begins.
void collect(const Triangle& t, int depth, const Span2& area, std::vector<std::vector<Triangle>>& runs, bool& broken) {
  const auto [low_x, high_x] = std::minmax({t.from.x, t.top.x, t.to.x});
  const auto [low_y, high_y] = std::minmax({t.from.y, t.top.y, t.to.y});
  if (high_x < area.min.x || low_x > area.max.x || high_y < area.min.y || low_y > area.max.y) {
    broken = true;
    return;
  }
  if (depth == 0) {
    if (broken) runs.emplace_back();
    broken = false;
    runs.back().push_back(t);
    return;
  }
  const Turned m = middle(t.from, t.to);
  collect({t.from, m, t.top}, depth - 1, area, runs, broken);
  collect({t.top, m, t.to}, depth - 1, area, runs, broken);
}

bool same(Turned a, Turned b, double within) {
  return std::abs(a.x - b.x) < within && std::abs(a.y - b.y) < within;
}

/// The two corners that two triangles share.
std::pair<Turned, Turned> shared(const Triangle& a, const Triangle& b, double within) {
  std::vector<Turned> both;
  for (const Turned p : {a.from, a.top, a.to})
    for (const Turned q : {b.from, b.top, b.to})
      if (same(p, q, within)) both.push_back(p);
  return both.size() >= 2 ? std::pair{both[0], both[1]} : std::pair{middle(a.from, a.to), middle(b.from, b.to)};
}

/// @param slide  where an edge is crossed, 0 … 1: the same way for all edges of a direction
Drawing draw(const PatternPlace& p, double leg, double slide) {
  int depth = 0;
  double side = leg;
  for (; side < 2 * p.reach + 2 * leg || depth % 2 != 0; side *= std::numbers::sqrt2) ++depth;
  const double h = side / 2;
  Span2 area = p.area;
  area.min.x -= leg, area.min.y -= leg, area.max.x += leg, area.max.y += leg;
  std::vector<std::vector<Triangle>> runs;
  bool broken = true;
  collect({{-h, -h}, {-h, h}, {h, h}}, depth, area, runs, broken);
  collect({{h, h}, {h, -h}, {-h, -h}}, depth, area, runs, broken);
  Drawing out{.pitch = leg};
  const double within = leg / 16;
  // vertices of the lattice of legs: even ones of the finest lattice end hypotenuses, the others are tops alone
  const auto crossing = [&](const Triangle& a, const Triangle& b) {
    auto [u, v] = shared(a, b, within);
    if (u.x > v.x + within || (std::abs(u.x - v.x) <= within && u.y > v.y)) std::swap(u, v);
    return Turned{std::lerp(u.x, v.x, slide), std::lerp(u.y, v.y, slide)};
  };
  const bool whole = runs.size() == 1 && runs[0].size() == (std::size_t{2} << static_cast<unsigned>(depth));
  for (const std::vector<Triangle>& run : runs) {
    if (run.size() < 2) continue;
    Curve& curve = out.curves.emplace_back();
    curve.closed = whole;
    for (std::size_t i = 1; i < run.size(); ++i) curve.points.push_back(crossing(run[i - 1], run[i]));
    if (whole) curve.points.push_back(crossing(run.back(), run.front()));
  }
  return out;
}

double leg_of(const PatternPlace& p) {
  return 1.138 * p.spacing();  // length of the curve in a triangle: 0.4394 of its legs' square for each leg
}

}  // namespace

Drawing draw_cross(const PatternPlace& p) {
  return draw(p, leg_of(p), 0.5);
}

/// Crossings slide along their edges with the height, to and fro, so that walls lean.
Drawing draw_cross_3d(const PatternPlace& p) {
  const double leg = leg_of(p), t = p.z / (2 * leg) - std::floor(p.z / (2 * leg));
  const double triangle = t < 0.5 ? 2 * t : 2 - 2 * t;
  const double free = std::clamp(p.band / leg, 0.0, 0.45);  // so that neighbours at a corner do not lie on each other
  return draw(p, leg, free + triangle * (1 - 2 * free));
}

}  // namespace weft::infill
