// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/steady.h"

#include "geometry/boolean.h"
#include "support/lengths.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft::support {
namespace {

/// Moments of an area about a point, µm, µm³ and so on.
struct Moments {
  double area = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;

  void add(const Ring& ring, Point about) {
    Point from = ring.back() - about;
    for (const Point corner : ring) {
      const Point to = corner - about;
      const double ax = from.x, ay = from.y, bx = to.x, by = to.y, cross = ax * by - bx * ay;
      area += cross / 2;
      x += (ax + bx) * cross / 6, y += (ay + by) * cross / 6;
      xx += (ax * ax + ax * bx + bx * bx) * cross / 12, yy += (ay * ay + ay * by + by * by) * cross / 12;
      xy += (ax * by + 2 * (ax * ay + bx * by) + bx * ay) * cross / 24;
      from = to;
    }
  }
};

}  // namespace

double stiff_width_um(const Region& region) {
  const Point about = box_of(region.outer).centre();
  Moments m;
  m.add(region.outer, about);
  for (const Ring& hole : region.holes) m.add(hole, about);
  const double x = m.x / m.area, y = m.y / m.area;
  const double xx = m.xx / m.area - x * x, yy = m.yy / m.area - y * y, xy = m.xy / m.area - x * y;
  const double least = (xx + yy) / 2 - std::hypot((xx - yy) / 2, xy);
  return std::sqrt(12 * std::max(least, 0.0));
}

bool Steady::widen(Um below_top, Regions& column) const {
  constexpr double steady = 10;  // height by width, at every height
  const Um step = line_ / 2;     // at each side
  const double least = below_top / steady - step;
  if (least <= line_) return false;
  bool wider = false;
  for (Region& region : column) {
    if (stiff_width_um(region) >= least) continue;
    Regions more = grown({region}, step);
    region = std::move(more.front()), wider = true;
  }
  if (wider && column.size() > 1) column = geometry::unite(column);
  return wider;
}

}  // namespace weft::support
