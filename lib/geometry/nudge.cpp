// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/nudge.h"

#include "geometry/boolean.h"
#include "geometry/simplify.h"
#include "geometry/wound.h"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

namespace weft::geometry {
namespace {

/// Where a corner lies when both its edges have moved to their right, but no further than twice as far.
Point moved_out(Point before, Point corner, Point after, Um by) {
  const double in = std::max(distance(before, corner), 1.0), on = std::max(distance(corner, after), 1.0);
  const double ux = (corner.y - before.y) / in, uy = (before.x - corner.x) / in;
  const double vx = (after.y - corner.y) / on, vy = (corner.x - after.x) / on;
  const double reach = by / std::max(1 + ux * vx + uy * vy, 0.5);
  return corner + Point{rounded(reach * (ux + vx)), rounded(reach * (uy + vy))};
}

Ring nudged_out(const Ring& ring, Um by) {
  Ring out;
  out.reserve(ring.size());
  for (std::size_t i = 0; i < ring.size(); ++i)
    out.push_back(
        moved_out(ring[i == 0 ? ring.size() - 1 : i - 1], ring[i], ring[i + 1 < ring.size() ? i + 1 : 0], by));
  return out;
}

}  // namespace

Regions nudged_out(const Regions& regions, Um by) {
  Regions out;
  out.reserve(regions.size());
  for (const Region& region : regions) {
    Region& wider = out.emplace_back(Region{nudged_out(region.outer, by), {}});
    for (const Ring& hole : region.holes) wider.holes.push_back(nudged_out(hole, by));
  }
  return out;
}

namespace {

/// Each by a little more than the one before it, so that none of them lies on another.
/// @param rings  that run the other way round
void nudge_apart(std::span<Ring> rings) {
  constexpr Um apart = 2;
  constexpr int kinds = 3;  // in turn
  int kind = 0;
  for (Ring& ring : rings) {
    ring = nudged_out(ring, -apart * (kind++ % kinds));
    drop_collinear(ring);
  }
}

/// @param wider  the other way round: what they wind around once or more often is wound around no more
/// @param hair   by which they are: nothing where that is to be exact
Regions less(const Region& region, const Regions& others, std::span<const Ring> wider, Um hair) {
  std::vector<Ring> rings = rings_of({region});
  const std::size_t own = rings.size();
  const Box box = box_of(region.outer);
  for (const Ring& ring : wider)
    if (box.overlaps(box_of(ring))) rings.push_back(ring);
  auto left = wound(rings, WindingRule::positive, box.centre());
  if (!left && hair > 0) {
    nudge_apart(std::span(rings).subspan(own));
    std::erase_if(rings, [](const Ring& ring) { return ring.size() < 3; });
    left = wound(rings, WindingRule::positive, box.centre());
  }
  if (!left) return subtract({region}, others);
  // Trimmed outlines may go round something the other way, but outside of what they were trimmed to.
  std::erase_if(*left, [&](const Region& piece) { return !box.contains(piece.outer.front()); });
  return *std::move(left);
}

}  // namespace

Regions beyond(const Regions& regions, const Regions& others, Um hair) {
  const Regions wider = hair == 0 ? others : nudged_out(others, hair);
  std::vector<Ring> rings;
  for (Ring& ring : rings_of(wider)) {
    drop_collinear(ring);
    if (ring.size() < 3) continue;
    std::reverse(ring.begin(), ring.end());
    rings.push_back(std::move(ring));
  }
  Regions out;
  for (const Region& region : regions)
    for (Region& left : less(region, wider, rings, hair)) out.push_back(std::move(left));
  return out;
}

Regions beyond(const Region& region, const Regions& others, Um hair) {
  return beyond(Regions{region}, others, hair);
}

Regions covered(const Region& region, const Regions& others, Um hair) {
  if (others.empty()) return {};
  const Regions bare = beyond(region, others, hair);
  return bare.empty() ? Regions{region} : beyond(region, bare, hair);
}

}  // namespace weft::geometry
