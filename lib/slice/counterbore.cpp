// SPDX-License-Identifier: GPL-3.0-or-later
#include "slice/counterbore.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace weft::slice {
namespace {

/// A round hole has flats wherever its polygon has edges, and is as wide one way as the other, nearly. Another
/// direction than the usual one must be that much better: a rectangle along a hexagon's flats is 0.87 of its largest.
constexpr double worth_turning = 0.95;

/// What a line notices: more than a line's quarter wide.
bool is_something(const Regions& what, Um line) {
  return !geometry::opening(what, line / 4).empty();
}

Regions filled(Ring ring) {
  std::reverse(ring.begin(), ring.end());  // holes run clockwise
  return {{std::move(ring), {}}};
}

/// A direction, and how far things reach along it and across.
struct Frame {
  double c = 1, s = 0;

  struct Reach {
    static constexpr double far = std::numeric_limits<double>::max();
    double low_u = far, high_u = -far, low_v = far, high_v = -far;
    double u() const { return high_u - low_u; }
    double v() const { return high_v - low_v; }
  };
  Reach of(const Ring& ring) const {
    Reach out;
    for (const Point p : ring) {
      const auto x = static_cast<double>(p.x), y = static_cast<double>(p.y);
      const double u = c * x + s * y, v = c * y - s * x;
      out.low_u = std::min(out.low_u, u), out.high_u = std::max(out.high_u, u);
      out.low_v = std::min(out.low_v, v), out.high_v = std::max(out.high_v, v);
    }
    return out;
  }
  Regions rectangle(const Reach& r) const {
    const auto at = [&](double u, double v) { return Point{rounded(c * u - s * v), rounded(s * u + c * v)}; };
    return {{{at(r.low_u, r.low_v), at(r.high_u, r.low_v), at(r.high_u, r.high_v), at(r.low_u, r.high_v)}, {}}};
  }
};

/// The frame of the smallest rectangle around the hole.
Frame frame_of(const Ring& hole) {
  Frame best;
  const auto area = [&](const Frame& frame) {
    const auto reach = frame.of(hole);
    return reach.u() * reach.v();
  };
  double least = worth_turning * area(best);
  for (std::size_t i = 0; i < hole.size(); ++i) {
    const Point along = hole[(i + 1) % hole.size()] - hole[i];
    const auto x = static_cast<double>(along.x), y = static_cast<double>(along.y);
    const Frame frame{x / std::hypot(x, y), y / std::hypot(x, y)};
    if (const double a = area(frame); a < least) least = a, best = frame;
  }
  return best;
}

/// The hole of the layer below in the middle of which the hole begins, filled; empty: none. Of a boss in a box that is
/// the boss's, not the inside of the box.
Regions wider_below(const Ring& hole, const Regions& below, Um line) {
  const Box needed = box_of(hole).grown(line);
  const Ring* innermost = nullptr;
  for (const auto& region : below)
    for (const auto& wide : region.holes)
      if (const Box box = box_of(wide); box.contains(needed.min) && box.contains(needed.max))
        if (innermost == nullptr || double_area(wide) > double_area(*innermost)) innermost = &wide;  // both clockwise
  if (innermost == nullptr) return {};
  auto out = filled(*innermost);
  return geometry::subtract(geometry::offset(filled(hole), {.by = line}), out).empty() ? out : Regions{};
}

void add(Regions& to, Regions&& what) {
  std::move(what.begin(), what.end(), std::back_inserter(to));
}

void cross(const FourLayers& layers, const Ring& ring, const Regions& wide, Um line, CounterboreCeiling& out) {
  const auto frame = frame_of(ring);
  auto of_hole = frame.of(ring);
  const auto of_wide = frame.of(wide.front().outer);
  const auto around = frame.rectangle(of_hole);
  const auto to_close = geometry::subtract(wide, around);
  for (const auto* above : {layers.next, layers.over})
    if (is_something(geometry::subtract(to_close, *above), line)) return;
  if (of_wide.v() * of_hole.u() >= worth_turning * of_wide.u() * of_hole.v())  // the smaller slot
    of_hole.low_u = of_wide.low_u, of_hole.high_u = of_wide.high_u;
  else
    of_hole.low_v = of_wide.low_v, of_hole.high_v = of_wide.high_v;
  const auto hole = filled(ring);
  add(out.open, geometry::subtract(geometry::intersect(wide, frame.rectangle(of_hole)), hole));
  add(out.open_next, geometry::subtract(around, hole));
  ++out.holes;
}

}  // namespace

CounterboreCeiling counterbore_ceiling(const FourLayers& layers, CounterboreHoleBridging how, Um line) {
  CounterboreCeiling out;
  for (const auto& region : *layers.own)
    for (const auto& hole : region.holes) {
      const auto wide = wider_below(hole, *layers.below, line);
      if (wide.empty()) continue;
      if (how == CounterboreHoleBridging::sacrificial) {
        add(out.closed, filled(hole));
        ++out.holes;
        continue;
      }
      const bool stands_in_it = is_something(geometry::intersect(wide, *layers.below), line);
      const auto other_holes = geometry::subtract(geometry::subtract(wide, *layers.own), filled(hole));
      if (!stands_in_it && !is_something(other_holes, line)) cross(layers, hole, wide, line, out);
    }
  return out;
}

}  // namespace weft::slice
