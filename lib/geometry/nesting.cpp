#include "geometry/nesting.h"

#include "core/tolerances.h"
#include "geometry/spatial_index.h"

#include <algorithm>
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
  std::vector<std::uint32_t> around;  ///< the rings that it lies inside of
  enum class Kind { nothing, outer, hole } kind = Kind::nothing;
};
}  // namespace

std::optional<Regions> nested(std::span<const Ring> rings, WindingRule rule) {
  const SegmentIndex index(rings);
  if (!index.simple()) return std::nullopt;
  std::vector<std::int64_t> areas(rings.size());
  for (std::size_t r = 0; r < rings.size(); ++r) areas[r] = double_area(rings[r]);

  std::vector<Place> places(rings.size());
  std::vector<SegmentIndex::RingWinding> windings;
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (std::abs(static_cast<double>(areas[r])) < 2 * tolerances::sliver_area_um2) continue;
    index.windings(*std::min_element(rings[r].begin(), rings[r].end()), windings);
    int outside = 0;
    for (const auto& other : windings) {
      outside += other.winding;
      if (other.winding != 0) places[r].around.push_back(other.ring);
    }
    const int inside = outside + (areas[r] > 0 ? 1 : -1);
    if (solid(outside, rule) != solid(inside, rule))
      places[r].kind = solid(inside, rule) ? Place::Kind::outer : Place::Kind::hole;
  }

  Regions out;
  std::vector<std::size_t> region_of(rings.size());
  for (std::size_t r = 0; r < rings.size(); ++r) {
    if (places[r].kind != Place::Kind::outer) continue;
    region_of[r] = out.size();
    out.push_back({rings[r], {}});
    if (areas[r] < 0) std::reverse(out.back().outer.begin(), out.back().outer.end());
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
    if (areas[r] > 0) std::reverse(holes.back().begin(), holes.back().end());
  }
  return out;
}

}  // namespace weft::geometry
