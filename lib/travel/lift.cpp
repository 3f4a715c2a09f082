#include "travel/lift.h"

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

bool inside(const std::vector<Point3>& points, const Ring& reach) {
  if (reach.size() < 3) return true;
  return std::all_of(points.begin(), points.end(), [&](Point3 p) { return side_of(reach, flat(p)) != Side::outside; });
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

std::vector<Point3> lifted(const RetractionSettings& settings, Point p, const Polyline& way, Um z, const Ring& reach) {
  const Um hop = settings.retraction_hop;
  std::vector<Point3> out;
  const double per_height = 1.0 / std::tan(settings.travel_slope * std::numbers::pi / 180.0);
  auto type = way.empty() || way.front() == p ? HopType::vertical : settings.retraction_hop_type;
  if (type == HopType::spiral) {
    const double radius_um = hop * per_height / (2 * std::numbers::pi);
    for (const bool left : {true, false}) {
      if (!out.empty()) break;
      auto turn = spiral(p, way.front(), radius_um, left, z, hop);
      if (inside(turn, reach)) out = std::move(turn);
    }
    if (out.empty()) type = HopType::slope;
  }
  if (type == HopType::slope) {
    slope(out, p, way, z, hop, hop * per_height);
  } else {
    if (type == HopType::vertical) out.push_back(at(p, z + hop));
    for (const Point q : way) out.push_back(at(q, z + hop));
  }
  const Point3 end = at(way.empty() ? p : way.back(), z);
  if (out.empty() || out.back() != end) out.push_back(end);
  return out;
}

}  // namespace weft::travel
