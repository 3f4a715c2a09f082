// SPDX-License-Identifier: GPL-3.0-or-later
#include "audit/path.h"

#include <cmath>
#include <numbers>

namespace weft::audit {
namespace {

constexpr double two_pi = 2 * std::numbers::pi;

/// Slack of a share along an edge or a path, so that a meeting at a corner is not lost between its two edges.
constexpr double share_slack = 1e-9;

/// How far along the arc, as a share of it, the direction `angle_rad` from the centre is met; > 1 when it is not.
double share_of(const Path& arc, double angle_rad) {
  double turn = std::fmod(arc.sweep_rad >= 0 ? angle_rad - arc.start_rad : arc.start_rad - angle_rad, two_pi);
  if (turn < 0) turn += two_pi;
  const double sweep = std::abs(arc.sweep_rad);
  if (turn > sweep && two_pi - turn <= share_slack * two_pi) turn = 0;  // a hair before the start
  return sweep > 0 ? turn / sweep : (turn > 0 ? 2.0 : 0.0);
}

bool meets_direction(const Path& arc, Vec direction) {
  if (std::abs(arc.sweep_rad) >= two_pi) return true;
  return share_of(arc, std::atan2(direction.y, direction.x)) <= 1 + share_slack;
}

int straight_meeting(const Path& path, Vec a, Vec b, double t[2]) {
  const Vec u = path.to - path.from, v = b - a, w = a - path.from;
  const double d = cross(u, v);
  if (d == 0) return 0;  // parallel: what follows an edge is judged by where it leaves it, at the neighbouring edges
  const double along_path = cross(w, v) / d, along_edge = cross(w, u) / d;
  if (along_path < -share_slack || along_path > 1 + share_slack || along_edge < -share_slack ||
      along_edge > 1 + share_slack)
    return 0;
  t[0] = std::clamp(along_path, 0.0, 1.0);
  return 1;
}

int arc_meetings(const Path& path, Vec a, Vec b, double t[2]) {
  const Vec v = b - a, w = a - path.centre;
  const double qa = dot(v, v), qb = dot(v, w), qc = dot(w, w) - path.radius_mm * path.radius_mm;
  const double disc = qb * qb - qa * qc;
  if (qa == 0 || disc < 0) return 0;
  const double root = std::sqrt(disc);
  int count = 0;
  for (const double s : {(-qb - root) / qa, (-qb + root) / qa}) {
    if (s < -share_slack || s > 1 + share_slack) continue;
    const Vec p = w + s * v;
    const double share = share_of(path, std::atan2(p.y, p.x));
    if (share <= 1 + share_slack) t[count++] = std::min(share, 1.0);
  }
  return count;
}

}  // namespace

double norm(Vec a) {
  return std::sqrt(dot(a, a));
}

Path arc_about(Vec from, Vec to, Vec centre, bool left, int turns) {
  Path p{.from = from, .to = to, .arc = true, .centre = centre};
  const Vec u = from - centre, v = to - centre;
  p.radius_mm = std::max(norm(u), norm(v));
  p.start_rad = std::atan2(u.y, u.x);
  if (from.x == to.x && from.y == to.y) {
    p.sweep_rad = left ? two_pi : -two_pi;
  } else {
    p.sweep_rad = std::atan2(cross(u, v), dot(u, v));
    if (left && p.sweep_rad < 0) p.sweep_rad += two_pi;
    if (!left && p.sweep_rad > 0) p.sweep_rad -= two_pi;
  }
  p.sweep_rad += (left ? two_pi : -two_pi) * turns;
  return p;
}

Vec at(const Path& path, double t) {
  if (!path.arc) return path.from + t * (path.to - path.from);
  const double angle_rad = path.start_rad + t * path.sweep_rad;
  return path.centre + path.radius_mm * Vec{std::cos(angle_rad), std::sin(angle_rad)};
}

double length_mm(const Path& path) {
  return path.arc ? path.radius_mm * std::abs(path.sweep_rad) : norm(path.to - path.from);
}

Bounds bounds_of(const Path& path) {
  Bounds box;
  box.add(path.from);
  box.add(path.to);
  if (path.arc)
    for (const Vec axis : {Vec{1, 0}, Vec{-1, 0}, Vec{0, 1}, Vec{0, -1}})
      if (meets_direction(path, axis)) box.add(path.centre + path.radius_mm * axis);
  return box;
}

Vec extreme(const Path& path, Vec direction) {
  if (path.arc && meets_direction(path, direction)) return path.centre + path.radius_mm * direction;
  return dot(path.from, direction) >= dot(path.to, direction) ? path.from : path.to;
}

Vec furthest_from(const Path& path, Vec p) {
  const Vec away = path.centre - p;
  if (path.arc && meets_direction(path, away)) {
    const double d = norm(away);
    return path.centre + path.radius_mm * (d > 0 ? (1 / d) * away : Vec{1, 0});
  }
  return norm(path.from - p) >= norm(path.to - p) ? path.from : path.to;
}

double distance(Vec p, Vec a, Vec b, Vec& nearest) {
  const Vec v = b - a;
  const double length2 = dot(v, v);
  const double s = length2 > 0 ? std::clamp(dot(p - a, v) / length2, 0.0, 1.0) : 0.0;
  nearest = a + s * v;
  return norm(p - nearest);
}

double distance(const Path& path, Vec a, Vec b) {
  double t[2];
  if (meetings(path, a, b, t) > 0) return 0;
  Vec ignored;
  double least = std::min(distance(path.from, a, b, ignored), distance(path.to, a, b, ignored));
  if (!path.arc)
    return std::min({least, distance(a, path.from, path.to, ignored), distance(b, path.from, path.to, ignored)});
  Vec foot;  // of the centre on ab: the point of ab nearest to the circle from within
  distance(path.centre, a, b, foot);
  for (const Vec q : {a, b, foot})
    if (meets_direction(path, q - path.centre))
      least = std::min(least, std::abs(norm(q - path.centre) - path.radius_mm));
  return least;
}

int meetings(const Path& path, Vec a, Vec b, double t[2]) {
  return path.arc ? arc_meetings(path, a, b, t) : straight_meeting(path, a, b, t);
}

}  // namespace weft::audit
