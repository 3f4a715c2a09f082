// SPDX-License-Identifier: GPL-3.0-or-later
#include "slice/interlock.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace weft::slice {
namespace {

constexpr Um touching = 50;  // parts with a gap of no more than twice that touch

Regions grown(const Regions& regions, Um by) {
  return geometry::offset(regions, {.by = by, .corner = geometry::Corner::miter});
}

/// Every second beam over a box.
Regions beams_over(const Box& box, Um width, double degrees) {
  const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  const std::array<Point, 4> corners{box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}};
  double low_u = 1e18, high_u = -1e18, low_v = 1e18, high_v = -1e18;  // along the beams, and across
  for (const Point p : corners) {
    const double u = c * p.x + s * p.y, v = c * p.y - s * p.x;
    low_u = std::min(low_u, u), high_u = std::max(high_u, u), low_v = std::min(low_v, v), high_v = std::max(high_v, v);
  }
  const double period = 2.0 * width;
  Regions out;
  for (double v = std::floor(low_v / period) * period; v < high_v; v += period) {
    const auto at = [&](double along, double across) {
      return Point{rounded(c * along - s * across), rounded(s * along + c * across)};
    };
    out.push_back({{at(low_u, v), at(high_u, v), at(high_u, v + width), at(low_u, v + width)}, {}});
  }
  return out;
}

}  // namespace

Interlocked interlocked(const InterlockStyle& style, std::size_t layer, const Regions& a, const Regions& b,
                        const Regions& may) {
  const Regions contact = geometry::intersect(grown(a, touching), grown(b, touching));
  if (contact.empty()) return {};
  Regions zone = grown(contact, style.depth * style.beam_width);
  zone = geometry::intersect(geometry::intersect(zone, may), geometry::unite(a, b));
  if (zone.empty()) return {};
  const bool across = layer / static_cast<std::size_t>(std::max(style.beam_layers, 1)) % 2 == 1;
  const Regions even =
      geometry::intersect(zone, beams_over(box_of(zone), style.beam_width, style.orientation_deg + (across ? 90 : 0)));
  // What is left of a beam at the zone's edge, and too narrow for a line, goes to the other.
  Interlocked out;
  out.to_a = geometry::intersect(geometry::opening(even, style.beam_width / 4, geometry::Corner::miter), even);
  out.to_b = geometry::subtract(zone, out.to_a);
  return out;
}

}  // namespace weft::slice
