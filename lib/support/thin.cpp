// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/thin.h"

#include "geometry/boolean.h"
#include "geometry/nudge.h"
#include "geometry/offset.h"
#include "geometry/spatial_index.h"
#include "geometry/trimmed.h"
#include "support/lengths.h"

#include <algorithm>

namespace weft::support {
namespace {

/// The boxes of pieces, wider.
Regions boxes_around(const Regions& pieces, Um by) {
  std::vector<Ring> rings;
  for (const Region& piece : pieces) {
    const Box box = box_of(piece.outer).grown(by);
    rings.push_back({box.min, {box.max.x, box.min.y}, box.max, {box.min.x, box.max.y}});
  }
  return geometry::regions_from_rings(rings);
}

}  // namespace

Regions near_to(const Region& region, const Regions& others, Um hair) {
  return geometry::trimmed(others, box_of(region.outer).grown(4 * hair));
}

void thicken(Regions& area, const Regions& fresh, Um line) {
  if (fresh.empty()) return;
  // What a disc inside of the area covers is told by what lies as near as its diameter.
  const Regions around = &area == &fresh ? area : geometry::intersect(area, boxes_around(fresh, 2 * line));
  // Corners are not thin: what grew around them would reach further than what they hold.
  const Regions wide = geometry::offset(geometry::offset(around, {.by = -line}), {.by = line + 20});
  const Regions thin = geometry::subtract(fresh, wide);
  if (thin.empty()) return;
  append(area, grown(thin, line));
  area = geometry::unite(area);
}

namespace {

constexpr Um rounded_off = 2;

/// Whether no corner of one, and no middle of an edge, is further from the other than offsets are rounded: a neck has
/// its corners where it begins to be one.
bool within(const Regions& inner, const geometry::SegmentIndex& outer) {
  const auto lies = [&](Point p) { return outer.nearest(p, rounded_off) || outer.region_at(p); };
  const auto all_lie = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i)
      if (!lies(ring[i]) || !lies(lerp(ring[i], ring[i + 1 < ring.size() ? i + 1 : 0], 0.5))) return false;
    return true;
  };
  return std::all_of(inner.begin(), inner.end(), [&](const Region& region) {
    return all_lie(region.outer) && std::all_of(region.holes.begin(), region.holes.end(), all_lie);
  });
}

}  // namespace

Regions without_thin(const Regions& area, Um radius) {
  const Regions wide = geometry::offset(geometry::offset(area, {.by = -radius}), {.by = radius, .miter_limit = 3});
  if (wide.empty()) return wide;
  // Only where a corner was cut off, the whole one reaches further.
  return within(wide, geometry::SegmentIndex(area))
             ? wide
             : geometry::intersect(wide, geometry::nudged_out(area, rounded_off));
}

}  // namespace weft::support
