// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/aside.h"

#include <cmath>

namespace weft::geometry {
namespace {

int sign(std::int64_t v) {
  return (v > 0) - (v < 0);
}

/// How far along an edge a point of it lies, 0 … 1: exactly so at its ends.
double along(const Segment& edge, Point p) {
  return static_cast<double>(dot(p - edge.a, edge.b - edge.a)) / static_cast<double>(distance2(edge.a, edge.b));
}

}  // namespace

Aside::Vector Aside::unit(Point from, Point to) {
  const double length = distance(from, to);
  return {(to.x - from.x) / length, (to.y - from.y) / length};
}

/// On which side of a direction what goes that way gets; 0 where doubles cannot tell.
int Aside::side_of(Vector way, Vector moved) {
  constexpr double least = 1e-9;  // sine: far above what doubles round
  const double sine = (way.x * moved.y - way.y * moved.x) / std::hypot(moved.x, moved.y);
  return sine > least ? 1 : sine < -least ? -1 : 0;
}

/// Which way a corner moves: both its edges by as much.
Aside::Vector Aside::way_of_corner(std::uint32_t ring, std::size_t nth) const {
  const Ring& corners = rings_[ring];
  const std::size_t n = corners.size();
  const Vector before = unit(corners[nth == 0 ? n - 1 : nth - 1], corners[nth]),
               after = unit(corners[nth], corners[nth + 1 < n ? nth + 1 : 0]);
  const double to = outwards_ ? 1 : -1;
  return {to * (before.y + after.y), -to * (before.x + after.x)};
}

int Aside::side_of_moved_end(const Segment& still, std::uint32_t moved, bool its_end) const {
  const std::uint32_t r = chains_.ring_of(moved);
  const std::size_t n = rings_[r].size(), from = moved - chains_.first_of(r);
  const std::size_t nth = its_end ? (from + 1 < n ? from + 1 : 0) : from;
  if (const int side = sign(orient(still.a, still.b, rings_[r][nth])); side != 0) return side;
  return side_of(unit(still.a, still.b), way_of_corner(r, nth));
}

int Aside::side_of_still_point(const Segment& moved, Point p) const {
  const int side = sign(orient(moved.a, moved.b, p));
  return side != 0 ? side : outwards_ ? 1 : -1;
}

Aside::Found Aside::find(std::uint32_t still, std::uint32_t moved, Crossing& out) const {
  const Segment s = chains_.edge(still), t = chains_.edge(moved);
  const int from = side_of_still_point(t, s.a), to = side_of_still_point(t, s.b);
  if (from == to) return Found::apart;
  const int begin = side_of_moved_end(s, moved, false), end = side_of_moved_end(s, moved, true);
  if (begin == 0 || end == 0) return Found::unsure;
  if (begin == end) return Found::apart;
  out.enters = to > 0;
  if (segments_cross(s.a, s.b, t.a, t.b)) {
    out.along_still = crossed_at(s.a, s.b, t.a, t.b), out.along_moved = crossed_at(t.a, t.b, s.a, s.b);
    out.at = lerp(s.a, s.b, out.along_still);
    out.then_still = out.then_moved = 0;
    return Found::crossing;
  }
  out.at = orient(s.a, s.b, t.a) == 0   ? t.a
           : orient(s.a, s.b, t.b) == 0 ? t.b
           : orient(t.a, t.b, s.a) == 0 ? s.a
                                        : s.b;
  out.along_still = along(s, out.at), out.along_moved = along(t, out.at);
  const Vector u = unit(s.a, s.b), v = unit(t.a, t.b);
  const double sine = u.x * v.y - u.y * v.x;  // of s with the way that t moves, outwards
  out.then_still = (outwards_ ? 1 : -1) / sine;
  out.then_moved = out.then_still * (u.x * v.x + u.y * v.y);
  return Found::crossing;
}

std::optional<bool> Aside::left_of(std::uint32_t ring, std::size_t nth, std::uint32_t other) const {
  if (ring < first_moved_) return outwards_;  // what it lies on moves away, or over it
  const Point p = rings_[ring][nth];
  const Vector way = way_of_corner(ring, nth);
  const Ring& around = rings_[other];
  const std::size_t n = around.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = around[i], b = around[i + 1 < n ? i + 1 : 0];
    if (!segments_touch(a, b, p, p)) continue;
    int side = side_of(unit(a, b), way);
    if (p == a || p == b) {
      const Point before = p == a ? around[i == 0 ? n - 1 : i - 1] : a;
      const Point after = p == a ? b : around[i + 2 < n ? i + 2 : i + 2 - n];
      const int first = side_of(unit(before, p), way), second = side_of(unit(p, after), way);
      side = orient(before, p, after) > 0 ? std::min(first, second) : std::max(first, second);
      if (first == 0 || second == 0) side = 0;
    }
    if (side == 0) return std::nullopt;
    return side > 0;
  }
  return std::nullopt;
}

}  // namespace weft::geometry
