// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/beside.h"

#include "geometry/offset.h"

#include <vector>

namespace weft::infill {

Beside::Beside(const Region& region, Um distance)
    : inner_(geometry::offset({region}, {.by = -distance})), edges_(inner_) {}

std::optional<Beside::Foot> Beside::met_by(const Polyline& from_edge) const {
  std::vector<geometry::SegmentIndex::Crossing> met;
  double way = 0;
  for (std::size_t i = 1; i < from_edge.size(); ++i) {
    const Point a = from_edge[i - 1], b = from_edge[i];
    met.clear();
    edges_.crossings(a, b, met);
    if (!met.empty()) {
      const double share = met.front().along;
      return Foot{met.front().segment,
                  {rounded(std::lerp(a.x, b.x, share)), rounded(std::lerp(a.y, b.y, share))},
                  way + share * distance(a, b)};
    }
    way += distance(a, b);
  }
  return std::nullopt;
}

std::optional<Polyline> Beside::way(const Foot& from, const Foot& to, double longest_um) const {
  const geometry::EdgeOfRegion first = edges_.origin(from.segment), last = edges_.origin(to.segment);
  if (first.region != last.region || first.ring != last.ring) return std::nullopt;
  const Region& region = inner_[first.region];
  const Ring& ring = first.ring == 0 ? region.outer : region.holes[first.ring - 1];
  Polyline out{from.at};
  double way = 0;
  const auto go_to = [&](Point p) {
    way += distance(out.back(), p);
    out.push_back(p);
    return way <= longest_um;
  };
  // on the same segment, but behind: once around
  const Point start = ring[first.edge];
  bool around = first.edge == last.edge && distance(start, to.at) < distance(start, from.at);
  for (std::uint32_t edge = first.edge; edge != last.edge || around; around = false) {
    edge = edge + 1 < ring.size() ? edge + 1 : 0;
    if (!go_to(ring[edge])) return std::nullopt;
  }
  if (!go_to(to.at)) return std::nullopt;
  return out;
}

}  // namespace weft::infill
