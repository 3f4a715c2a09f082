// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/trimmed.h"

#include <utility>

namespace weft::geometry {
namespace {

/// On which sides of the box a point is, a bit each.
unsigned sides_of(const Box& box, Point p) {
  return (p.x < box.min.x ? 1U : 0U) | (p.x > box.max.x ? 2U : 0U) | (p.y < box.min.y ? 4U : 0U) |
         (p.y > box.max.y ? 8U : 0U);
}

/// A corner goes where it, the one that was kept before it and the next are on one side of the box: the ring is then
/// only changed within that half-plane, and winds as often as before around what is beyond it. The first one stays.
Ring trimmed(const Ring& ring, const Box& box) {
  Ring out;
  const std::size_t n = ring.size();
  if (n < 3) return out;
  unsigned before = sides_of(box, ring[0]), here = sides_of(box, ring[1]);
  out.push_back(ring[0]);
  for (std::size_t i = 1; i < n; ++i) {
    const unsigned after = sides_of(box, ring[i + 1 < n ? i + 1 : 0]);
    if ((before & here & after) == 0) out.push_back(ring[i]), before = here;
    here = after;
  }
  if (out.size() < 3) out.clear();
  return out;
}

}  // namespace

Regions trimmed(std::span<const Region> regions, const Box& box) {
  Regions out;
  for (const Region& region : regions) {
    const Box own = box_of(region.outer);
    if (!own.overlaps(box)) continue;
    if (box.contains(own.min) && box.contains(own.max)) {
      out.push_back(region);
      continue;
    }
    Region less{trimmed(region.outer, box), {}};
    if (less.outer.empty()) continue;
    for (const Ring& hole : region.holes)
      if (auto left = trimmed(hole, box); !left.empty()) less.holes.push_back(std::move(left));
    out.push_back(std::move(less));
  }
  return out;
}

}  // namespace weft::geometry
