// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/convex.h"

#include <cmath>
#include <vector>

namespace weft::geometry {
namespace {

/// An edge's direction, of length 1.
struct Direction {
  double x = 0, y = 0;
};
double cross(Direction a, Direction b) {
  return a.x * b.y - a.y * b.x;
}

}  // namespace

bool runs_round_convex(const Ring& ring) {
  const std::size_t n = ring.size();
  if (n < 3) return false;
  const auto rises = [](Point d) { return d.y > 0 || (d.y == 0 && d.x > 0); };
  int rounds = 0;
  Point before = ring[n - 1];
  for (std::size_t i = 0; i < n; ++i) {
    const Point at = ring[i], after = ring[i + 1 < n ? i + 1 : 0], comes = at - before, goes = after - at;
    const auto turn = orient(before, at, after);
    if (turn < 0 || (turn == 0 && dot(comes, goes) <= 0)) return false;
    rounds += !rises(comes) && rises(goes) ? 1 : 0;
    before = at;
  }
  return rounds == 1;
}

std::optional<Ring> inset_of_convex(const Ring& ring, Um by) {
  const std::size_t n = ring.size();
  if (n < 3) return std::nullopt;
  std::vector<Direction> along(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = ring[i], b = ring[i + 1 < n ? i + 1 : 0];
    const double length = distance(a, b);
    if (length == 0) return std::nullopt;
    along[i] = {(b.x - a.x) / length, (b.y - a.y) / length};
  }
  constexpr double least_turn = 1e-6;
  double turned = 0;
  Ring out(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Direction u = along[i > 0 ? i - 1 : n - 1], v = along[i];
    const double turn = cross(u, v), cosine = u.x * v.x + u.y * v.y;
    if (turn < least_turn) return std::nullopt;
    turned += std::atan2(turn, cosine);
    // Both edges, moved to their left, meet along the bisector.
    const double t = by * (1 - cosine) / turn;
    out[i] = {rounded(ring[i].x - by * u.y - t * u.x), rounded(ring[i].y + by * u.x - t * u.y)};
  }
  if (turned > 7) return std::nullopt;  // more than once around
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = out[i], b = out[i + 1 < n ? i + 1 : 0];
    if ((b.x - a.x) * along[i].x + (b.y - a.y) * along[i].y <= 0) return std::nullopt;
  }
  return out;
}

}  // namespace weft::geometry
