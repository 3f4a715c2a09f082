// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>

/// The geometry of one motion, seen from above. Everything in this folder measures in millimetres and double: the
/// numbers of a G-code file are decimals of any length, and a lattice would round what is to be judged.
namespace weft::audit {

struct Vec {
  double x = 0, y = 0;
};
constexpr Vec operator+(Vec a, Vec b) {
  return {a.x + b.x, a.y + b.y};
}
constexpr Vec operator-(Vec a, Vec b) {
  return {a.x - b.x, a.y - b.y};
}
constexpr Vec operator*(double s, Vec a) {
  return {s * a.x, s * a.y};
}
constexpr double dot(Vec a, Vec b) {
  return a.x * b.x + a.y * b.y;
}
constexpr double cross(Vec a, Vec b) {
  return a.x * b.y - a.y * b.x;
}
double norm(Vec a);

/// An axis-aligned box, mm; empty when min > max.
struct Bounds {
  Vec min{1e300, 1e300}, max{-1e300, -1e300};
  void add(Vec p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y)};
  }
  bool empty() const { return min.x > max.x || min.y > max.y; }
  /// Does it hold p with `margin` to spare on every side?
  bool holds(Vec p, double margin) const {
    return p.x >= min.x + margin && p.x <= max.x - margin && p.y >= min.y + margin && p.y <= max.y - margin;
  }
  bool overlaps(const Bounds& o, double margin) const {
    return min.x - margin <= o.max.x && o.min.x <= max.x + margin && min.y - margin <= o.max.y &&
           o.min.y <= max.y + margin;
  }
};

/// A straight segment, or an arc about `centre` from `from` to `to`.
struct Path {
  Vec from, to;
  bool arc = false;
  Vec centre{};
  double radius_mm = 0;                 ///< of the end that is further from the centre
  double start_rad = 0, sweep_rad = 0;  ///< sweep > 0 turns left; from 2π on every direction from the centre is met
};

/// The arc about `centre`, turning left or right. Full circle when the ends are equal; `turns` adds whole circles.
Path arc_about(Vec from, Vec to, Vec centre, bool left, int turns);

/// The point at share t of the path.
Vec at(const Path& path, double t);
double length_mm(const Path& path);
Bounds bounds_of(const Path& path);

/// The point of the path furthest along `direction` (a unit vector). Exact for arcs: their extreme, not a sample.
Vec extreme(const Path& path, Vec direction);

/// The point of the path furthest from p.
Vec furthest_from(const Path& path, Vec p);

/// Shortest distance between the path and the segment ab, mm; 0 when they meet.
double distance(const Path& path, Vec a, Vec b);

/// Distance of a point from the segment ab, mm; `nearest` is set to the point of ab next to it.
double distance(Vec p, Vec a, Vec b, Vec& nearest);

/// Where the path meets the segment ab: shares t of the path, at most two. @return how many
int meetings(const Path& path, Vec a, Vec b, double t[2]);

}  // namespace weft::audit
