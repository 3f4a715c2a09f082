// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/lift.h"

#include "travel/way.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace weft::travel {
namespace {

constexpr int spiral_corners = 16;

Point3 at(Point p, Um z) {
  return {p.x, p.y, z};
}

/// One turn around a circle that the way touches at p, on the given side of it, rising to z + hop.
std::vector<Point3> spiral(Point p, Point towards, double radius_um, bool left, Um z, Um hop) {
  const double length = distance(p, towards);
  const double ux = (static_cast<double>(towards.x) - p.x) / length,
               uy = (static_cast<double>(towards.y) - p.y) / length;
  const double side = left ? 1.0 : -1.0;
  std::vector<Point3> turn;
  for (int k = 1; k <= spiral_corners; ++k) {
    const double a = 2 * std::numbers::pi * k / spiral_corners;
    const double along = radius_um * std::sin(a), across = side * radius_um * (1 - std::cos(a));
    turn.push_back({rounded(p.x + ux * along - uy * across), rounded(p.y + uy * along + ux * across),
                    static_cast<Um>(z + static_cast<std::int64_t>(hop) * k / spiral_corners)});
  }
  return turn;
}

bool meets(Point a, Point b, const Ring& ring) {
  for (std::size_t i = 0, k = ring.size() - 1; i < ring.size(); k = i++)
    if (segments_touch(a, b, ring[k], ring[i])) return true;
  return false;
}

/// A circle through p that touches the edge of the reach counts as leaving it.
bool inside(Point from, const std::vector<Point3>& points, const Room& room) {
  const bool bounded = room.reach.size() >= 3;
  for (const Point3& to : points) {
    const Point p = flat(to);
    if (bounded && (side_of(room.reach, p) == Side::outside || meets(from, p, room.reach))) return false;
    for (const auto& area : room.no_go)
      if (side_of(area, p) != Side::outside || meets(from, p, area)) return false;
    from = p;
  }
  return true;
}

/// Rises along the way at the slope until the hop is reached.
void slope(std::vector<Point3>& out, Point p, const Polyline& way, Um z, Um hop, double ramp_um) {
  double gone = 0;
  for (const Point q : way) {
    const double step = distance(p, q);
    if (gone < ramp_um && gone + step > ramp_um) out.push_back(at(lerp(p, q, (ramp_um - gone) / step), z + hop));
    gone += step;
    out.push_back(at(q, z + rounded(hop * std::min(1.0, gone / ramp_um))));
    p = q;
  }
}

}  // namespace

Lift lifted(const RetractionSettings& settings, Point p, const Polyline& way, Um z, const Room& room) {
  Lift lift;
  const Um hop = std::clamp<Um>(room.z_max - z, 0, settings.retraction_hop);
  lift.lowered = hop < settings.retraction_hop;
  auto& out = lift.path;
  const double per_height = 1.0 / std::tan(settings.travel_slope * std::numbers::pi / 180.0);
  lift.type = hop == 0 || way.empty() || way.front() == p ? HopType::vertical : settings.retraction_hop_type;
  if (lift.type == HopType::spiral) {
    const double radius_um = hop * per_height / (2 * std::numbers::pi);
    for (const bool left : {true, false}) {
      if (!out.empty()) break;
      auto turn = spiral(p, way.front(), radius_um, left, z, hop);
      if (inside(p, turn, room)) out = std::move(turn);
    }
    if (out.empty()) lift.type = HopType::slope;
  }
  if (lift.type == HopType::slope && length_from(p, way) < hop * per_height) lift.type = HopType::vertical;
  if (lift.type == HopType::slope) {
    slope(out, p, way, z, hop, hop * per_height);
  } else {
    if (lift.type == HopType::vertical) out.push_back(at(p, z + hop));
    for (const Point q : way) out.push_back(at(q, z + hop));
  }
  const Point3 end = at(way.empty() ? p : way.back(), z);
  if (out.empty() || out.back() != end) out.push_back(end);
  return lift;
}

}  // namespace weft::travel
