// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/seam.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace weft::travel {
namespace {

/// Half the stretch of wall over which a corner's turn is measured, µm: about a line's width.
constexpr double reach_um = 500;
/// Turns below this are no corner, rad.
constexpr double least_turn_rad = 0.35;
struct Vec {
  double x, y;
};
Vec between(Point a, Point b) {
  return {static_cast<double>(b.x) - a.x, static_cast<double>(b.y) - a.y};
}

/// The direction from junction i as seen `reach_um` along the bead, in steps of ±1. length(k) is how far junction k is
/// from the next.
template <class Length>
Vec direction(const std::vector<Junction>& path, const Length& length, std::size_t i, bool forward) {
  const std::size_t n = path.size();
  std::size_t k = i;
  double gone = 0;
  for (std::size_t steps = 1; steps < n; ++steps) {
    const std::size_t next = forward ? (k + 1 < n ? k + 1 : 0) : (k > 0 ? k : n) - 1;
    const double step = length(forward ? k : next);
    if (gone + step >= reach_um) {
      const Point p = lerp(path[k].at, path[next].at, step > 0 ? (reach_um - gone) / step : 0.0);
      return between(path[i].at, p);
    }
    gone += step;
    k = next;
  }
  return between(path[i].at, path[k].at);
}

/// Signed turn from a direction that is looked back in to one that is looked ahead in, rad: > 0 to the left.
double turn_between(Vec in, Vec out) {
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

}  // namespace

std::vector<Corner> corners_of(const Bead& bead, SeamCorner kind, bool material_left, std::size_t most) {
  std::vector<Corner> corners;
  if (kind == SeamCorner::none || bead.path.size() < 3) return corners;
  const std::size_t n = bead.path.size();
  std::vector<double> lengths(n);  // measured once: a curve is looked along from each of its junctions
  for (std::size_t i = 0; i < n; ++i) lengths[i] = distance(bead.path[i].at, bead.path[i + 1 < n ? i + 1 : 0].at);
  const auto length = [&](std::size_t i) { return lengths[i]; };
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = (i > 0 ? i : n) - 1;
    const Point a = bead.path[before].at, b = bead.path[i].at, c = bead.path[i + 1 < n ? i + 1 : 0].at;
    // A turn within the half millimetre needs a turn here: most junctions of a curve are passed over cheaply.
    const double local = std::abs(static_cast<double>(orient(a, b, c)));
    if (local < 0.05 * lengths[before] * lengths[i] && dot(b - a, c - b) > 0) continue;
    const double turn = turn_between(direction(bead.path, length, i, false), direction(bead.path, length, i, true));
    if (std::abs(turn) < least_turn_rad) continue;
    const double strength = strength_of(turn, (turn < 0) == material_left, kind);
    if (strength > 0) corners.push_back({static_cast<std::uint32_t>(i), static_cast<float>(strength), 0.F});
  }
  std::stable_sort(corners.begin(), corners.end(),
                   [](const Corner& a, const Corner& b) { return a.strength > b.strength; });
  // A copy of the few that are kept: layers wait with them, and the vector has room for every corner there was.
  return {corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(std::min(corners.size(), most))};
}

Start nearest_start(const Bead& bead, Point p, Um snap) {
  Start best;
  double best2 = std::numeric_limits<double>::infinity(), best_t = 0;
  const std::size_t n = bead.path.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = bead.path[i].at, b = bead.path[i + 1 < n ? i + 1 : 0].at;
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

void add_exposure(const Bead& bead, bool material_left, const Comb& outline, std::span<Corner> corners) {
  constexpr int rays = 8;
  constexpr double ray_um = 5000;
  static const auto turns = [] {  // of rays against the first
    std::array<Vec, rays> out;
    for (std::size_t k = 0; k < rays; ++k) {
      const double angle = 2 * std::numbers::pi * (static_cast<double>(k) + 0.5) / rays;
      out[k] = {std::cos(angle), std::sin(angle)};
    }
    return out;
  }();
  const auto length = [&](std::size_t i) {
    return distance(bead.path[i].at, bead.path[i + 1 < bead.path.size() ? i + 1 : 0].at);
  };
  for (auto& corner : corners) {
    const Vec in = direction(bead.path, length, corner.junction, false),
              out = direction(bead.path, length, corner.junction, true);
    const double turn = turn_between(in, out);
    // Outwards halfway between the two sides: to the right of the way when material is on its left.
    const double heading = std::atan2(out.y, out.x) - turn / 2;
    const double outwards = heading + (material_left ? -0.5 : 0.5) * std::numbers::pi;
    const Point p = bead.path[corner.junction].at;
    const double step = 1.5 * bead.path[corner.junction].width / std::max(0.3, std::cos(turn / 2));
    const Vec way{std::cos(outwards), std::sin(outwards)};
    const Point eye{rounded(p.x + step * way.x), rounded(p.y + step * way.y)};
    int open = 0;
    for (const Vec& turned : turns) {
      const Vec ray{way.x * turned.x - way.y * turned.y, way.x * turned.y + way.y * turned.x};
      if (outline.sees(eye, {rounded(eye.x + ray_um * ray.x), rounded(eye.y + ray_um * ray.y)})) ++open;
    }
    corner.exposure = static_cast<float>(2.0 * open / rays - 1.0);
  }
}

Start rearmost_start(const Bead& bead) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < bead.path.size(); ++i) {
    const Point p = bead.path[i].at, q = bead.path[best].at;
    if (p.y > q.y || (p.y == q.y && p.x > q.x)) best = i;
  }
  return at_junction(bead, best);
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

double hang_of(const Bead& bead, const Start& start, const Comb& below) {
  if (below.part_of(start.at) != Comb::outside) return 0;
  const Um half = bead.path[start.segment].width / 2;
  const auto edge = below.nearest_on_boundary(start.at, half);
  return edge ? std::min(1.0, distance(*edge, start.at) / half) : 1.0;
}

std::vector<Start> borne_places(const Bead& bead, const Comb& below) {
  constexpr double step_um = 500;
  std::vector<Start> places;
  const std::size_t n = bead.path.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Point a = bead.path[i].at, b = bead.path[i + 1 < n ? i + 1 : 0].at;
    const auto steps = static_cast<int>(std::ceil(distance(a, b) / step_um));
    for (int k = 0; k < steps; ++k)
      if (const Start place{static_cast<std::uint32_t>(i), lerp(a, b, static_cast<double>(k) / steps)};
          hang_of(bead, place, below) <= most_hang)
        places.push_back(place);
  }
  return places;
}

}  // namespace weft::travel
