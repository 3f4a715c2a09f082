// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/skeleton.h"

#include "core/stop.h"

#include <algorithm>
#include <cmath>

namespace weft::walls {
namespace {

using geometry::MedialAxis;

Place on_rib(Place foot, const Skeleton::Node& node, double d) {
  return node.clearance > 1e-6 ? lerp(foot, node.at, d / node.clearance) : node.at;
}

/// Nearest point of a site to a place in its cell.
Place foot_on(const MedialAxis::Site& site, Place p) {
  if (site.corner) return site.a;
  const double ux = site.b.x - site.a.x, uy = site.b.y - site.a.y;
  const double t = ((p.x - site.a.x) * ux + (p.y - site.a.y) * uy) / (ux * ux + uy * uy);
  return lerp(site.a, site.b, std::clamp(t, 0.0, 1.0));
}

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
  Skeleton::Node at(double x) const {
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

/// Interior nodes of an edge of the axis.
void sample(const MedialAxis& axis, std::uint32_t half_edge, double chord, std::vector<Skeleton::Node>& out) {
  const auto& forward = axis.half_edges[half_edge];
  const auto& backward = axis.half_edges[MedialAxis::twin(half_edge)];
  const auto &s = axis.sites[forward.site], &t = axis.sites[backward.site];
  if (!s.corner && !t.corner) return;
  const auto &a = axis.nodes[forward.from], &b = axis.nodes[backward.from];
  if (distance(a.at, b.at) < 2) return;
  const Curve curve = curve_of(s, t);
  if (!(curve.h > 0.5)) return;
  const double from = curve.angle_of(curve.x_of(a.at)), to = curve.angle_of(curve.x_of(b.at));
  const double widest = std::max({a.clearance, b.clearance, 1.0});
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

}  // namespace

double Skeleton::length(std::uint32_t edge) const {
  return distance(nodes[halves[2 * edge].from].at, nodes[halves[2 * edge + 1].from].at);
}
Place Skeleton::on_start_rib(std::uint32_t half, double d) const {
  return on_rib(halves[half].foot, start(half), d);
}
Place Skeleton::on_end_rib(std::uint32_t half, double d) const {
  return on_rib(halves[halves[half].next].foot, end(half), d);
}

std::uint32_t Skeleton::split(std::uint32_t edge, double t) {
  const std::uint32_t h = 2 * edge, back = h + 1;
  const auto n = static_cast<std::uint32_t>(nodes.size()), g = static_cast<std::uint32_t>(halves.size());
  const Node &a = start(h), &b = end(h);
  const Node middle{lerp(a.at, b.at, t), a.clearance + t * (b.clearance - a.clearance)};
  const Place right = lerp(halves[h].foot, halves[halves[h].next].foot, t);
  const Place left = lerp(halves[back].foot, halves[halves[back].next].foot, 1 - t);
  nodes.push_back(middle);
  const std::uint32_t after = halves[h].next, before = halves[back].previous;
  halves.push_back({n, after, h, right});                                  // g: n → b
  halves.push_back({halves[back].from, back, before, halves[back].foot});  // g + 1: b → n
  if (after == back) {                                                     // the edge ended in a leaf
    halves[g].next = g + 1;
    halves[g + 1].previous = g;
  } else {
    halves[after].previous = g;
    halves[before].next = g + 1;
  }
  halves[h].next = g;
  halves[back].from = n;
  halves[back].foot = left;
  halves[back].previous = g + 1;
  return g / 2;
}

Skeleton skeleton_of(const MedialAxis& axis, double chord) {
  Skeleton out;
  out.nodes.reserve(axis.nodes.size() * 2);
  out.halves.reserve(axis.half_edges.size() * 2);
  for (const auto& node : axis.nodes) out.nodes.push_back({node.at, node.clearance});
  std::vector<std::uint32_t> first(axis.half_edges.size()), last(axis.half_edges.size());
  std::vector<Skeleton::Node> inner;
  StopNowAndThen stop(128);
  for (std::uint32_t k = 0; k < axis.half_edges.size(); k += 2) {
    stop.step();
    inner.clear();
    sample(axis, k, chord, inner);
    const auto& right = axis.sites[axis.half_edges[k].site];
    const auto& left = axis.sites[axis.half_edges[k + 1].site];
    std::uint32_t from = axis.half_edges[k].from;
    first[k] = last[k + 1] = static_cast<std::uint32_t>(out.halves.size());
    ++last[k + 1];
    for (std::size_t i = 0; i <= inner.size(); ++i) {
      std::uint32_t to = axis.half_edges[k + 1].from;
      if (i < inner.size()) {
        to = static_cast<std::uint32_t>(out.nodes.size());
        out.nodes.push_back(inner[i]);
      }
      const auto h = static_cast<std::uint32_t>(out.halves.size());
      out.halves.push_back({from, h + 2, h - 2, foot_on(right, out.nodes[from].at)});
      out.halves.push_back({to, h - 1, h + 3, foot_on(left, out.nodes[to].at)});
      from = to;
    }
    last[k] = static_cast<std::uint32_t>(out.halves.size()) - 2;
    first[k + 1] = last[k] + 1;
  }
  for (std::uint32_t k = 0; k < axis.half_edges.size(); ++k) {
    const std::uint32_t next = first[axis.half_edges[k].next];
    out.halves[last[k]].next = next;
    out.halves[next].previous = last[k];
  }
  return out;
}

}  // namespace weft::walls
