// SPDX-License-Identifier: GPL-3.0-or-later
#include "audit/shape.h"

#include <algorithm>
#include <cmath>

namespace weft::audit {
namespace {

/// Two excesses within this are equal, and the tie is broken by where the path as a whole is further out.
constexpr double tie_mm = 1e-6;

}  // namespace

Shape Shape::disc(Vec centre, double radius_mm) {
  Shape s;
  s.disc_ = true;
  s.centre_ = centre;
  s.radius_mm_ = radius_mm;
  s.bounds_.add(centre - Vec{radius_mm, radius_mm});
  s.bounds_.add(centre + Vec{radius_mm, radius_mm});
  return s;
}

Shape Shape::polygon(const Ring& ring) {
  Shape s;
  const std::size_t n = ring.size();
  const bool reversed = double_area(ring) < 0;
  const auto corner = [&](std::size_t i) { return ring[reversed ? n - 1 - i % n : i % n]; };
  for (std::size_t i = 0; i < n; ++i) {
    const Point p = corner(i), q = corner(i + 1);
    if (p == q) continue;
    const Vec a{to_mm(p.x), to_mm(p.y)}, b{to_mm(q.x), to_mm(q.y)};
    const double length = norm(b - a);
    const Vec outward{(b.y - a.y) / length, (a.x - b.x) / length};
    s.edges_.push_back({a, b, outward, dot(outward, a)});
    s.bounds_.add(a);
    if (orient(p, q, corner(i + 2)) < 0) s.convex_ = false;
  }
  return s;
}

Excess Shape::leaving(const Path& path, double margin_mm) const {
  if (disc_) return beyond_disc(path, margin_mm);
  return convex_ ? beyond_edges(path, margin_mm) : worst_stretch(path, margin_mm, false);
}

Excess Shape::entering(const Path& path, double margin_mm) const {
  if (!bounds_.overlaps(bounds_of(path), margin_mm)) return {};
  Excess e = worst_stretch(path, margin_mm, true);
  e.side = Side::no_go;
  return e;
}

/// A convex shape holds the path when each of its edges' lines does.
Excess Shape::beyond_edges(const Path& path, double margin_mm) const {
  Excess worst;
  worst.mm = -1e300;
  double tie = 0;
  for (const Edge& e : edges_) {
    const Vec p = extreme(path, e.outward);
    const double mm = dot(e.outward, p) - e.offset + margin_mm;
    const Side side = side_towards(e.outward);
    auto& there = worst.by_side[static_cast<std::size_t>(side)];
    there = std::max(there, mm);
    const double whole = dot(e.outward, path.from) + dot(e.outward, path.to) - 2 * e.offset;
    if (mm > worst.mm + tie_mm || (mm > worst.mm - tie_mm && whole > tie)) {
      worst.mm = mm, worst.at = p, worst.side = side;
      tie = whole;
    }
  }
  return worst;
}

Excess Shape::beyond_disc(const Path& path, double margin_mm) const {
  Excess e;
  e.at = furthest_from(path, centre_);
  const Vec out = e.at - centre_;
  e.mm = norm(out) + margin_mm - radius_mm_;
  e.side = side_towards(out);
  e.by_side[static_cast<std::size_t>(e.side)] = e.mm;
  return e;
}

bool Shape::holds(Vec p) const {
  bool inside = false;
  for (const Edge& e : edges_)
    if ((e.a.y > p.y) != (e.b.y > p.y) && p.x < e.a.x + (p.y - e.a.y) / (e.b.y - e.a.y) * (e.b.x - e.a.x))
      inside = !inside;
  return inside;
}

double Shape::distance_to_outline(Vec p, Vec& nearest) const {
  double least = 1e300;
  Vec q;
  for (const Edge& e : edges_)
    if (const double d = distance(p, e.a, e.b, q); d < least) least = d, nearest = q;
  return least;
}

/// The point between two meetings with the outline that is furthest from it. The distance has several humps beside a
/// concave outline: sampled, then narrowed about the best sample. The verdict needs it only against the tolerance.
Excess Shape::deepest(const Path& path, double from, double to) const {
  constexpr int samples = 16;
  Excess best;
  Vec nearest_to_best, nearest;
  double low = from, high = to;
  for (int round = 0; round < 4; ++round) {
    const double step = (high - low) / samples;
    double best_t = low;
    for (int i = 0; i <= samples; ++i) {
      const Vec p = audit::at(path, low + i * step);
      const double d = distance_to_outline(p, nearest);
      if (d > best.mm) best.mm = d, best.at = p, best_t = low + i * step, nearest_to_best = nearest;
    }
    low = std::max(from, best_t - step), high = std::min(to, best_t + step);
  }
  best.side = side_towards(best.at - nearest_to_best);
  return best;
}

/// The worst stretch of the path that lies inside (or outside) the polygon; without one, how far its margin reaches
/// over.
Excess Shape::worst_stretch(const Path& path, double margin_mm, bool inside) const {
  double least = 1e300;
  const Edge* nearest = nullptr;
  for (const Edge& e : edges_)
    if (const double d = distance(path, e.a, e.b); d < least) least = d, nearest = &e;
  Excess worst;
  if (least > 0) {  // the outline is not met: all of the path is on one side of it
    if (holds(path.from) == inside) {
      worst = deepest(path, 0, 1);
      worst.mm += margin_mm;
    } else if (least < margin_mm) {
      worst.mm = margin_mm - least;
      worst.at = extreme(path, nearest->outward);
      worst.side = side_towards(nearest->outward);
    }
  } else {
    worst = worst_between_meetings(path, inside);
    worst.mm = std::max(worst.mm, 0.0) + margin_mm;
  }
  if (worst.side != Side::none) worst.by_side[static_cast<std::size_t>(worst.side)] = worst.mm;
  return worst;
}

Excess Shape::worst_between_meetings(const Path& path, bool inside) const {
  std::vector<double> stops{0.0, 1.0};
  double t[2];
  Excess worst;
  for (const Edge& e : edges_)
    for (int i = meetings(path, e.a, e.b, t); i-- > 0;) {
      stops.push_back(t[i]);
      if (worst.side == Side::none) worst = {.mm = 0, .at = audit::at(path, t[i]), .side = side_towards(e.outward)};
    }
  std::sort(stops.begin(), stops.end());
  for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
    if (stops[i + 1] - stops[i] <= 1e-12 || holds(audit::at(path, (stops[i] + stops[i + 1]) / 2)) != inside) continue;
    if (const Excess e = deepest(path, stops[i], stops[i + 1]); e.mm > worst.mm) worst = e;
  }
  return worst;
}

bool Shape::box() const {
  return !disc_ && convex_ &&
         std::all_of(edges_.begin(), edges_.end(), [](const Edge& e) { return e.a.x == e.b.x || e.a.y == e.b.y; });
}

Path Shape::from_inside(const Path& path) const {
  if (leaving({.from = path.from, .to = path.from}, 0).mm <= 0) return path;
  Path rest = path;
  rest.from = path.to;
  if (disc_ || convex_) return rest;  // what lies between a place inside and the end, which is judged, is inside
  std::vector<double> stops{1.0};
  double t[2];
  for (const Edge& e : edges_)
    for (int i = meetings(path, e.a, e.b, t); i-- > 0;) stops.push_back(t[i]);
  std::sort(stops.begin(), stops.end());
  for (std::size_t i = 0; i + 1 < stops.size(); ++i)
    if (stops[i + 1] - stops[i] > 1e-12 && holds(audit::at(path, (stops[i] + stops[i + 1]) / 2))) {
      rest.from = audit::at(path, stops[i]);
      break;
    }
  return rest;
}

Bounds Shape::inner_box() const {
  const Vec middle = 0.5 * (bounds_.min + bounds_.max), half = 0.5 * (bounds_.max - bounds_.min);
  const auto box = [&](double share) {
    Bounds b;
    b.add(middle - share * half);
    b.add(middle + share * half);
    return b;
  };
  const auto fits = [&](double share) {
    const Bounds b = box(share);
    const Vec corner[] = {b.min, {b.max.x, b.min.y}, b.max, {b.min.x, b.max.y}};
    for (int i = 0; i < 4; ++i)
      if (leaving({.from = corner[i], .to = corner[(i + 1) % 4]}, 0).mm > 0) return false;
    return true;
  };
  if (fits(1)) return bounds_;
  double low = 0, high = 1;
  if (!fits(low)) return {};
  for (int i = 0; i < 30; ++i) (fits((low + high) / 2) ? low : high) = (low + high) / 2;
  return box(low);
}

}  // namespace weft::audit
