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

void Steady::begin(const Regions& contacts, Um z) {
  const Um aside = 2 * line_;  // beside a wall columns lean, to what is nearer than they may stand
  for (const Region& contact : contacts) tops_.push_back({box_of(contact.outer).grown(aside), z});
}

bool Steady::widen(Um z, Regions& columns) const {
  constexpr double steady = 10;  // height by width, at every height
  const Um step = line_ / 2;     // at each side
  bool wider = false;
  for (Region& column : columns) {
    const Box box = box_of(column.outer);
    const auto top = std::find_if(tops_.begin(), tops_.end(), [&](const Top& t) { return t.box.overlaps(box); });
    if (top == tops_.end()) continue;  // the first is the highest
    const double least = (top->z - z) / steady - step;
    if (least <= line_ || stiff_width_um(column) >= least) continue;
    Regions more = grown({column}, step);
    column = std::move(more.front()), wider = true;
  }
  if (wider && columns.size() > 1) columns = geometry::unite(columns);
  return wider;
}

}  // namespace weft::support
