// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/reaches_further.h"

#include "geometry/boolean.h"
#include "geometry/spatial_index.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace weft::pipeline {
namespace {

/// Places of outlines that run beside others are mostly near to the edge that the place before was near to, or to one
/// soon after it.
class Further {
 public:
  Further(const Regions& than, Um by) : regions_(than), by_(by) {
    for (const Ring& ring : geometry::rings_of(than))
      for (std::size_t i = 0; i < ring.size(); ++i) edges_.push_back({ring[i], ring[i + 1 < ring.size() ? i + 1 : 0]});
  }
  bool any_of(const Region& region) {
    const auto any = [this](const Ring& ring) {
      for (std::size_t i = 0; i < ring.size(); ++i)
        if (any_on({ring[i], ring[i + 1 < ring.size() ? i + 1 : 0]})) return true;
      return false;
    };
    return any(region.outer) || std::any_of(region.holes.begin(), region.holes.end(), any);
  }

 private:
  /// A strip between two wide places may have corners only where it ends.
  bool any_on(const geometry::Segment& edge) {
    const int pieces = std::max(1, static_cast<int>(std::ceil(distance(edge.a, edge.b) / by_)));
    for (int k = 0; k < pieces; ++k)
      if (lies(lerp(edge.a, edge.b, k * 1.0 / pieces))) return true;
    return false;
  }
  bool lies(Point p) {
    constexpr std::size_t soon = 128;  // then an index of them all costs less
    for (std::size_t k = 0; k < std::min(soon, edges_.size()); ++k) {
      const std::size_t i = (last_ + k) % edges_.size();
      if (geometry::foot_of(p, edges_[i]).distance_um > by_) continue;
      last_ = i;
      return false;
    }
    if (!all_) all_.emplace(regions_);
    const auto nearest = all_->nearest(p, by_);
    if (nearest) last_ = nearest->segment;
    return !nearest;
  }

  const Regions& regions_;
  double by_;
  std::vector<geometry::Segment> edges_;
  std::size_t last_ = 0;
  std::optional<geometry::SegmentIndex> all_;
};

}  // namespace

bool reaches_further(const Region& region, const Regions& within, Um by) {
  return Further(within, by).any_of(region);
}

}  // namespace weft::pipeline
