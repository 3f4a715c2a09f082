// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/beneath.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace weft::pipeline {
namespace {

geometry::SegmentIndex index_of(const Beads& beads) {
  std::vector<geometry::Segment> segments;
  for (const Bead& bead : beads) {
    const auto& path = bead.path;
    for (std::size_t i = 1; i < path.size(); ++i) segments.push_back({path[i - 1].at, path[i].at});
    if (bead.closed) segments.push_back({path.back().at, path.front().at});
  }
  return geometry::SegmentIndex(std::move(segments));
}

}  // namespace

Beneath::Beneath(const Regions& areas, const Beads& beads, Um line)
    : areas_(areas), beads_(index_of(beads)), line_(line) {}

bool Beneath::lies(Point p) const {
  return areas_.region_at(p) || areas_.nearest(p, line_ / 4) || beads_.nearest(p, line_ * 3 / 4);
}

double Beneath::hanging_um(const Bead& bead, Um span) const {
  constexpr double step = 300;
  const auto& path = bead.path;
  std::optional<double> first;  // how far along it is the first rest
  double along = 0, since = 0, hangs = 0;
  const auto rest = [&] {
    if (!first)
      first = since;
    else if (since > span)
      hangs += since;
    since = 0;
  };
  for (std::size_t i = 0, n = path.size(); i + (bead.closed ? 0 : 1) < n; ++i) {
    const Point a = path[i].at, b = path[i + 1 < n ? i + 1 : 0].at;
    const double length = distance(a, b);
    const int pieces = std::max(1, static_cast<int>(length / step));
    for (int k = 0; k < pieces; ++k) {
      if (lies(lerp(a, b, (k + 0.5) / pieces)))
        rest();
      else
        since += length / pieces;
    }
    along += length;
  }
  if (!first) return along;
  if (!bead.closed) return hangs + *first + since;
  return hangs + (*first + since > span ? *first + since : 0);
}

double Beneath::hanging_um(std::span<const Bead> beads, Um span) const {
  double um = 0;
  for (const Bead& bead : beads) um += hanging_um(bead, span);
  return um;
}

}  // namespace weft::pipeline
