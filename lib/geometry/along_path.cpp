// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/along_path.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace weft::geometry {
namespace {

/// Calls f(from, to, box) of places that lie together in a box no wider than a few beads.
template <class F>
void for_each_run(std::span<const Point> places, F&& f) {
  constexpr Um together = 2000;
  for (std::size_t from = 0, to = 0; from < places.size(); from = to) {
    Box box;
    for (; to < places.size(); ++to) {
      Box wider = box;
      wider.add(places[to]);
      if (to > from && std::max(wider.size().x, wider.size().y) > together) break;
      box = wider;
    }
    f(from, to, box);
  }
}

/// Of segments those that meet a box.
class Met {
 public:
  explicit Met(const SegmentIndex& segments) : segments_(segments) {}

  std::span<const Segment> in(const Box& box) {
    segments_.near(box, found_);
    met_.clear();
    for (const std::uint32_t i : found_)
      if (segments_.segments()[i].box().overlaps(box)) met_.push_back(segments_.segments()[i]);
    return met_;
  }

 private:
  const SegmentIndex& segments_;
  std::vector<std::uint32_t> found_;
  std::vector<Segment> met_;
};

}  // namespace

std::vector<char> lie_near(std::span<const Point> places, const SegmentIndex& segments, double within) {
  std::vector<char> out(places.size(), 0);
  Met all(segments);
  for_each_run(places, [&](std::size_t from, std::size_t to, const Box& box) {
    const auto met = all.in(box.grown(static_cast<Um>(std::ceil(within))));
    std::size_t last = 0;  // what runs along a segment is near to it again
    for (std::size_t i = from; i < to; ++i)
      for (std::size_t k = 0; k < met.size() && out[i] == 0; ++k) {
        const std::size_t m = last + k < met.size() ? last + k : last + k - met.size();
        if (foot_of(places[i], met[m]).distance_um <= within) out[i] = 1, last = m;
      }
  });
  return out;
}

std::vector<char> lie_within(std::span<const Point> places, const SegmentIndex& regions) {
  std::vector<char> out(places.size(), 0);
  Met all(regions);
  for_each_run(places, [&](std::size_t from, std::size_t to, const Box& box) {
    if (!box.overlaps(regions.box())) return;
    const auto edges = all.in(box);
    const auto between = [&](Point a, Point b) {
      const Box way = Segment{a, b}.box();
      return std::any_of(edges.begin(), edges.end(), [&](const Segment& edge) { return edge.box().overlaps(way); });
    };
    for (std::size_t i = from; i < to; ++i)
      out[i] =
          i > from && !between(places[i - 1], places[i]) ? out[i - 1] : char{regions.region_at(places[i]).has_value()};
  });
  return out;
}

}  // namespace weft::geometry
