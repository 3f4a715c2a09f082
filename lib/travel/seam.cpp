#include "travel/seam.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace weft::travel {
namespace {

/// Half the stretch of wall over which a corner's turn is measured, µm: about a line's width.
constexpr double reach_um = 500;
/// Turns below this are no corner, rad.
constexpr double least_turn_rad = 0.35;
/// A corner of full strength is worth this long a jump from the seam of the layer below, µm.
constexpr double corner_worth_um = 3000;
/// Seams of the layer below farther off than this belong to something else, µm.
constexpr double same_line_um = 6000;
/// A seam this near to a junction begins at it, µm.
constexpr Um snap_um = 50;

struct Vec {
  double x, y;
};
Vec between(Point a, Point b) {
  return {static_cast<double>(b.x) - a.x, static_cast<double>(b.y) - a.y};
}

/// The direction from junction i as seen `reach_um` along the bead, in steps of ±1.
Vec direction(const std::vector<Junction>& path, std::size_t i, bool forward) {
  const std::size_t n = path.size();
  std::size_t k = i;
  double gone = 0;
  for (std::size_t steps = 1; steps < n; ++steps) {
    const std::size_t next = forward ? (k + 1) % n : (k + n - 1) % n;
    const double step = distance(path[k].at, path[next].at);
    if (gone + step >= reach_um) {
      const Point p = lerp(path[k].at, path[next].at, step > 0 ? (reach_um - gone) / step : 0.0);
      return between(path[i].at, p);
    }
    gone += step;
    k = next;
  }
  return between(path[i].at, path[k].at);
}

/// Signed turn at junction i, rad: > 0 to the left.
double turn_at(const std::vector<Junction>& path, std::size_t i) {
  const Vec in = direction(path, i, false), out = direction(path, i, true);
  return std::atan2(-(in.x * out.y - in.y * out.x), -(in.x * out.x + in.y * out.y));
}

double strength_of(double turn_rad, bool inner, SeamCorner kind) {
  const double sharpness = std::min(1.0, std::abs(turn_rad) / (0.75 * std::numbers::pi));
  switch (kind) {
    case SeamCorner::none:
      return 0;
    case SeamCorner::inner:
      return inner ? sharpness : 0;
    case SeamCorner::outer:
      return inner ? 0 : sharpness;
    case SeamCorner::any:
      return sharpness;
    case SeamCorner::weighted:
      return inner ? sharpness : 0.7 * sharpness;
  }
  return 0;
}

std::uint64_t mixed(std::uint64_t x) {  // splitmix64, Steele et al. 2014
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

Start at_junction(const Bead& bead, std::size_t i) {
  return {static_cast<std::uint32_t>(i), bead.path[i].at};
}

Start random_start(const Bead& bead, std::uint64_t seed) {
  const double total = length_mm(bead) * 1000.0;
  double left = total * (static_cast<double>(mixed(seed) >> 11) * 0x1p-53);
  for (std::size_t i = 0; i < bead.path.size(); ++i) {
    const Point a = bead.path[i].at, b = bead.path[(i + 1) % bead.path.size()].at;
    const double step = distance(a, b);
    if (left < step) return {static_cast<std::uint32_t>(i), lerp(a, b, left / step)};
    left -= step;
  }
  return at_junction(bead, 0);
}

/// The place of least cost among the corners, where cost(point, strength) is in µm.
template <class Cost>
Start cheapest(const Bead& bead, std::span<const Corner> corners, Start plain, const Cost& cost) {
  Start best = plain;
  double least = cost(plain.at, 0.0);
  for (const auto& c : corners) {
    const double value = cost(bead.path[c.junction].at, static_cast<double>(c.strength));
    if (value < least) least = value, best = at_junction(bead, c.junction);
  }
  return best;
}

Start rearmost(const Bead& bead) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < bead.path.size(); ++i) {
    const Point p = bead.path[i].at, q = bead.path[best].at;
    if (p.y > q.y || (p.y == q.y && p.x > q.x)) best = i;
  }
  return at_junction(bead, best);
}

}  // namespace

std::vector<Corner> corners_of(const Bead& bead, SeamCorner kind, std::size_t most) {
  std::vector<Corner> corners;
  if (kind == SeamCorner::none || bead.path.size() < 3) return corners;
  std::int64_t twice_area = 0;
  for (std::size_t i = 1; i + 1 < bead.path.size(); ++i)
    twice_area += orient(bead.path[0].at, bead.path[i].at, bead.path[i + 1].at);
  // Material lies inside an outer contour and outside a hole: Region's orientation, which walls keep, says which it is.
  // An inner (concave) corner turns right when material is on the left.
  for (std::size_t i = 0; i < bead.path.size(); ++i) {
    const std::size_t n = bead.path.size();
    const Point a = bead.path[(i + n - 1) % n].at, b = bead.path[i].at, c = bead.path[(i + 1) % n].at;
    // A turn within the half millimetre needs a turn here: most junctions of a curve are passed over cheaply.
    const double local = std::abs(static_cast<double>(orient(a, b, c)));
    if (local < 0.05 * distance(a, b) * distance(b, c) && dot(b - a, c - b) > 0) continue;
    const double turn = turn_at(bead.path, i);
    if (std::abs(turn) < least_turn_rad) continue;
    const double strength = strength_of(turn, turn < 0, kind);
    if (strength > 0) corners.push_back({static_cast<std::uint32_t>(i), static_cast<float>(strength)});
  }
  std::stable_sort(corners.begin(), corners.end(),
                   [](const Corner& a, const Corner& b) { return a.strength > b.strength; });
  if (corners.size() > most) corners.resize(most);
  return corners;
}

Start nearest_start(const Bead& bead, Point p, Um snap) {
  Start best;
  double best2 = std::numeric_limits<double>::infinity(), best_t = 0;
  const std::size_t n = bead.path.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = bead.path[i].at, b = bead.path[(i + 1) % n].at;
    const double ux = static_cast<double>(b.x) - a.x, uy = static_cast<double>(b.y) - a.y;
    const double px = static_cast<double>(p.x) - a.x, py = static_cast<double>(p.y) - a.y;
    const double length2 = ux * ux + uy * uy;
    const double t = length2 > 0 ? std::clamp((px * ux + py * uy) / length2, 0.0, 1.0) : 0.0;
    const double dx = px - t * ux, dy = py - t * uy;
    const double d2 = dx * dx + dy * dy;
    if (d2 < best2) best2 = d2, best_t = t, best.segment = static_cast<std::uint32_t>(i);
  }
  const std::size_t i = best.segment, next = (i + 1) % n;
  best.at = lerp(bead.path[i].at, bead.path[next].at, best_t);
  if (distance(best.at, bead.path[i].at) <= snap) return at_junction(bead, i);
  if (distance(best.at, bead.path[next].at) <= snap) return at_junction(bead, next);
  return best;
}

Start choose_seam(const TravelSettings& settings, const Bead& bead, std::span<const Corner> corners,
                  std::span<const Point> below, std::uint64_t seed) {
  if (settings.z_seam_type == SeamType::random) return random_start(bead, seed);
  if (settings.z_seam_type == SeamType::user) {
    const Point goal{settings.z_seam_x, settings.z_seam_y};
    const Start plain = nearest_start(bead, goal, snap_um);
    const auto cost = [&](Point p, double strength) { return distance(p, goal) - corner_worth_um * strength; };
    return cheapest(bead, corners, plain, cost);
  }
  if (settings.z_seam_type == SeamType::back) {
    const auto cost = [&](Point p, double strength) { return -static_cast<double>(p.y) - corner_worth_um * strength; };
    return cheapest(bead, corners, rearmost(bead), cost);
  }
  // The line of the seam below, if this wall continues one.
  const Start plain_start = rearmost(bead);
  Start plain = plain_start;
  double nearest = same_line_um;
  for (const Point q : below) {
    const Start s = nearest_start(bead, q, snap_um);
    const double d = distance(s.at, q);
    if (d < nearest) nearest = d, plain = s;
  }
  const bool continued = nearest < same_line_um;
  const Point line = plain.at;
  if (settings.z_seam_type == SeamType::sharpest_corner || !continued) {
    // The strongest corner; among equals the one on the line below.
    const auto cost = [&](Point p, double strength) {
      return -100 * corner_worth_um * std::round(strength * 20) +
             (continued ? distance(p, line) : -static_cast<double>(p.y) / 1000);
    };
    return cheapest(bead, corners, plain, cost);
  }
  const auto cost = [&](Point p, double strength) { return distance(p, line) - corner_worth_um * strength; };
  return cheapest(bead, corners, plain, cost);
}

}  // namespace weft::travel
