// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/microns.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>

namespace weft {

/// A point, or a vector between two, on the lattice of whole microns.
struct Point {
  Um x = 0, y = 0;
  friend constexpr bool operator==(Point, Point) = default;
  friend constexpr auto operator<=>(Point, Point) = default;
};

constexpr Point operator+(Point a, Point b) {
  return {a.x + b.x, a.y + b.y};
}
constexpr Point operator-(Point a, Point b) {
  return {a.x - b.x, a.y - b.y};
}
constexpr Point operator-(Point a) {
  return {-a.x, -a.y};
}

/// A place in the machine.
struct Point3 {
  Um x = 0, y = 0, z = 0;
  friend constexpr bool operator==(Point3, Point3) = default;
  friend constexpr auto operator<=>(Point3, Point3) = default;
};
constexpr Point flat(Point3 p) {
  return {p.x, p.y};
}

/// Twice the signed area of the triangle abc; > 0 when c lies left of a->b. Exact.
constexpr std::int64_t orient(Point a, Point b, Point c) {
  const std::int64_t ux = std::int64_t{b.x} - a.x, uy = std::int64_t{b.y} - a.y;
  const std::int64_t vx = std::int64_t{c.x} - a.x, vy = std::int64_t{c.y} - a.y;
  return ux * vy - uy * vx;
}

/// Whether ab and cd cross properly: in one point that is an end of neither. Exact.
constexpr bool segments_cross(Point a, Point b, Point c, Point d) {
  const auto sign = [](std::int64_t v) { return (v > 0) - (v < 0); };
  return sign(orient(a, b, c)) * sign(orient(a, b, d)) < 0 && sign(orient(c, d, a)) * sign(orient(c, d, b)) < 0;
}

/// Where the line cd crosses ab: 0 at a … 1 at b. Pre: a and b are not on one side of cd, nor both on it.
constexpr double crossed_at(Point a, Point b, Point c, Point d) {
  const auto from = static_cast<double>(orient(c, d, a)), to = static_cast<double>(orient(c, d, b));
  return from / (from - to);
}

/// Whether ab and cd have a point in common, ends included. Exact.
constexpr bool segments_touch(Point a, Point b, Point c, Point d) {
  if (std::max(a.x, b.x) < std::min(c.x, d.x) || std::max(c.x, d.x) < std::min(a.x, b.x) ||
      std::max(a.y, b.y) < std::min(c.y, d.y) || std::max(c.y, d.y) < std::min(a.y, b.y))
    return false;
  const auto sign = [](std::int64_t v) { return (v > 0) - (v < 0); };
  return sign(orient(a, b, c)) * sign(orient(a, b, d)) <= 0 && sign(orient(c, d, a)) * sign(orient(c, d, b)) <= 0;
}

/// Dot product of two difference vectors, µm². Exact.
constexpr std::int64_t dot(Point a, Point b) {
  return std::int64_t{a.x} * b.x + std::int64_t{a.y} * b.y;
}

/// Squared distance, µm². Exact.
constexpr std::int64_t distance2(Point a, Point b) {
  const std::int64_t x = std::int64_t{b.x} - a.x, y = std::int64_t{b.y} - a.y;
  return x * x + y * y;
}

/// Distance in fractional microns.
inline double distance(Point a, Point b) {
  return std::sqrt(static_cast<double>(distance2(a, b)));
}

/// The point at fraction t of a->b, to the nearest micron; ties away from a, so that a moved line gives the moved
/// point.
inline Point lerp(Point a, Point b, double t) {
  return {a.x + rounded(t * (static_cast<double>(b.x) - a.x)), a.y + rounded(t * (static_cast<double>(b.y) - a.y))};
}

}  // namespace weft
