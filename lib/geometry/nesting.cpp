#include "geometry/nesting.h"

#include "core/tolerances.h"

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

/// Any point of a ring tells what is around it, as long as no other ring touches it there.
std::vector<Place> places_of(std::span<const Ring> rings, const SegmentIndex& index) {
  std::vector<Place> places(rings.size());
  std::vector<SegmentIndex::RingWinding> windings;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    places[r].double_area = double_area(rings[r]);
    if (places[r].sliver()) continue;
    for (const Point p : rings[r]) {
      index.windings(p, windings);
      const auto touching = [&](const auto& w) { return w.on && w.ring != r; };
      if (std::none_of(windings.begin(), windings.end(), touching)) break;
    }
    for (const auto& other : windings) {
      if (other.ring == r || other.winding == 0) continue;
      places[r].outside += other.winding;
      places[r].around.push_back(other.ring);
    }
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
  for (std::size_t r = 0; r < rings.size(); ++r) {
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

std::optional<Regions> nested(std::span<const Ring> rings, WindingRule rule) {
  const SegmentIndex index(rings);
  if (!index.simple()) return std::nullopt;
  auto places = places_of(rings, index);
  for (auto& place : places) {
    if (place.sliver()) continue;
    const int inside = place.outside + (place.double_area > 0 ? 1 : -1);
    if (solid(place.outside, rule) != solid(inside, rule))
      place.kind = solid(inside, rule) ? Place::Kind::outer : Place::Kind::hole;
  }
  return assembled(rings, places);
}

Regions nested_by_orientation(std::span<const Ring> rings, const SegmentIndex& index) {
  auto places = places_of(rings, index);
  for (auto& place : places)
    if (!place.sliver()) place.kind = place.double_area > 0 ? Place::Kind::outer : Place::Kind::hole;
  return assembled(rings, places);
}

}  // namespace weft::geometry
