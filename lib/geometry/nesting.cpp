// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/nesting.h"

#include "core/stop.h"
#include "core/tolerances.h"
#include "geometry/convex.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace weft::geometry {
namespace {

bool solid(int winding, WindingRule rule) {
  switch (rule) {
    case WindingRule::nonzero:
      return winding != 0;
    case WindingRule::positive:
      return winding > 0;
    case WindingRule::even_odd:
      return winding % 2 != 0;
  }
  return false;
}

/// A ring among the others.
struct Place {
  std::int64_t double_area = 0;
  std::vector<std::uint32_t> around;  ///< the rings that it lies inside of
  int outside = 0;                    ///< winding number around it
  enum class Kind { nothing, outer, hole } kind = Kind::nothing;
  bool sliver() const { return std::abs(static_cast<double>(double_area)) < 2 * tolerances::sliver_area_um2; }
};

/// What is around ring r, asked of everything to its left. Any point of a ring tells, as long as no other ring touches
/// it there.
void look_around(std::size_t r, const Ring& ring, const RingEdges& edges,
                 std::vector<SegmentIndex::RingWinding>& windings, Place& place) {
  for (const Point p : ring) {
    edges.windings(p, windings);
    const auto touching = [&](const auto& w) { return w.on && w.ring != r; };
    if (std::none_of(windings.begin(), windings.end(), touching)) break;
  }
  for (const auto& other : windings) {
    if (other.ring == r || other.winding == 0) continue;
    place.outside += other.winding;
    place.around.push_back(other.ring);
  }
}

/// What is around each ring, found from its neighbour to the left, which is looked at before it: either both lie in the
/// same rings, or the neighbour is around it. A look at everything to the left would take rings^1.5 steps.
/// Pre: no two rings touch, none touches itself.
void ask_neighbours(std::span<const Ring> rings, const RingEdges& edges, std::vector<Place>& places) {
  std::vector<std::pair<Point, std::uint32_t>> leftmost;
  leftmost.reserve(rings.size());
  for (std::uint32_t r = 0; r < rings.size(); ++r)
    if (!places[r].sliver()) leftmost.emplace_back(*std::min_element(rings[r].begin(), rings[r].end()), r);
  std::sort(leftmost.begin(), leftmost.end());
  std::vector<SegmentIndex::RingWinding> windings;
  StopNowAndThen stop(16);
  for (const auto& [p, r] : leftmost) {
    stop.step();
    const auto met = edges.first_left_of(p);
    if (met == RingEdges::none) continue;
    const auto left = met == RingEdges::unsure ? r : edges.ring_of(met);
    if (left == r || places[left].sliver()) {
      look_around(r, rings[r], edges, windings, places[r]);
      continue;
    }
    places[r].around = places[left].around;
    places[r].outside = places[left].outside;
    const Segment edge = edges.edge(met);
    const bool counter_clockwise = places[left].double_area > 0;
    if ((edge.a.y > edge.b.y) != counter_clockwise) continue;  // p is on its outer side
    places[r].around.push_back(left);
    places[r].outside += counter_clockwise ? 1 : -1;
  }
}

/// @param by_neighbours  each place is told from its neighbour's: rings must not touch each other nor themselves
std::vector<Place> places_of(std::span<const Ring> rings, const RingEdges& edges, bool by_neighbours) {
  std::vector<Place> places(rings.size());
  for (std::size_t r = 0; r < rings.size(); ++r) places[r].double_area = double_area(rings[r]);
  if (by_neighbours) {
    ask_neighbours(rings, edges, places);
    return places;
  }
  std::vector<SegmentIndex::RingWinding> windings;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    stop_if_asked();
    if (!places[r].sliver()) look_around(r, rings[r], edges, windings, places[r]);
  }
  return places;
}

Regions assembled(std::span<const Ring> rings, const std::vector<Place>& places) {
  Regions out;
  std::vector<std::size_t> region_of(rings.size());
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (places[r].kind != Place::Kind::outer) continue;
    region_of[r] = out.size();
    out.push_back({rings[r], {}});
    if (places[r].double_area < 0) std::reverse(out.back().outer.begin(), out.back().outer.end());
  }
  StopNowAndThen stop(64);
  for (std::size_t r = 0; r < rings.size(); ++r) {
    stop.step();
    if (places[r].kind != Place::Kind::hole) continue;
    // The innermost outer around it: up to there all is solid.
    std::optional<std::uint32_t> parent;
    for (const std::uint32_t a : places[r].around)
      if (places[a].kind == Place::Kind::outer && (!parent || places[a].around.size() > places[*parent].around.size()))
        parent = a;
    if (!parent) continue;  // it was a hole of a sliver
    auto& holes = out[region_of[*parent]].holes;
    holes.push_back(rings[r]);
    if (places[r].double_area > 0) std::reverse(holes.back().begin(), holes.back().end());
  }
  return out;
}
}  // namespace

Regions nested(std::span<const Ring> rings, const RingEdges& edges, WindingRule rule) {
  auto places = places_of(rings, edges, !edges.scattered());
  for (auto& place : places) {
    if (place.sliver()) continue;
    const int inside = place.outside + (place.double_area > 0 ? 1 : -1);
    if (solid(place.outside, rule) != solid(inside, rule))
      place.kind = solid(inside, rule) ? Place::Kind::outer : Place::Kind::hole;
  }
  return assembled(rings, places);
}

Regions nested_by_orientation(std::span<const Ring> rings, const RingEdges& edges) {
  // Asking for simplicity pays from 32 convex rings of 8 corners on, and from about 400 of 32 corners (measured); at
  // 256 neither way loses 0.1 ms.
  constexpr std::size_t many = 256;
  auto places = places_of(rings, edges, rings.size() > many && !edges.scattered() && edges.simple());
  for (auto& place : places)
    if (!place.sliver()) place.kind = place.double_area > 0 ? Place::Kind::outer : Place::Kind::hole;
  return assembled(rings, places);
}

std::optional<Regions> convex_alone(std::span<const Ring> rings) {
  if (rings.size() != 1 || !runs_round_convex(rings.front())) return std::nullopt;
  if (static_cast<double>(double_area(rings.front())) < 2 * tolerances::sliver_area_um2) return Regions{};
  return Regions{{rings.front(), {}}};
}

}  // namespace weft::geometry
