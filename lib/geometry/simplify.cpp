// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/simplify.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/convex.h"
#include "geometry/ring_edges.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace weft::geometry {
namespace {

constexpr double most_area_share = 0.0075;  // chords cut off corners of a small ring: what it loses is to be less

bool needless(Point before, Point at, Point after) {
  return orient(before, at, after) == 0;
}

/// Directions from an anchor along which a chord passes all points seen so far within the bound.
class Cone {
 public:
  Cone(Point anchor, double bound) : anchor_(anchor), bound_(bound) {}

  enum class Verdict {
    passes,       ///< the chord from the anchor to p passes every point seen so far within the bound
    ends_short,   ///< it would, but for a point seen that lies beyond its end
    leaves_some,  ///< it does not
  };
  Verdict of(Point p) const {
    const double x = static_cast<double>(p.x) - anchor_.x, y = static_cast<double>(p.y) - anchor_.y;
    if (!holds(x, y)) return Verdict::leaves_some;
    return x * x + y * y < farthest2_ ? Verdict::ends_short : Verdict::passes;
  }
  /// Narrows the cone so that chords keep within the bound of p.
  void see(Point p) {
    const double x = static_cast<double>(p.x) - anchor_.x, y = static_cast<double>(p.y) - anchor_.y;
    const double length2 = x * x + y * y;
    farthest2_ = std::max(farthest2_, length2);
    if (length2 <= bound_ * bound_) return;                     // every chord from the anchor passes it
    const double reach = std::sqrt(length2 - bound_ * bound_);  // tangents to the circle about p
    const double rx = x * reach + y * bound_, ry = y * reach - x * bound_;
    const double lx = x * reach - y * bound_, ly = y * reach + x * bound_;
    if (!bounded_ || right_x_ * ry - right_y_ * rx > 0) right_x_ = rx, right_y_ = ry;
    if (!bounded_ || left_x_ * ly - left_y_ * lx < 0) left_x_ = lx, left_y_ = ly;
    bounded_ = true;
  }

 private:
  bool holds(double x, double y) const {
    if (!bounded_) return true;
    return right_x_ * y - right_y_ * x >= 0 && left_x_ * y - left_y_ * x <= 0 &&
           (right_x_ + left_x_) * x + (right_y_ + left_y_) * y > 0;
  }

  Point anchor_;
  double bound_;
  double farthest2_ = 0;
  bool bounded_ = false;
  double right_x_ = 0, right_y_ = 0, left_x_ = 0, left_y_ = 0;
};
}  // namespace

void drop_collinear(Ring& ring) {
  std::size_t kept = 0;
  for (const Point p : ring) {
    while (kept >= 2 && needless(ring[kept - 2], ring[kept - 1], p)) --kept;
    if (kept == 1 && ring[0] == p) continue;
    ring[kept++] = p;
  }
  std::size_t first = 0;
  for (bool changed = true; changed && kept - first >= 3;) {  // the seam
    changed = false;
    if (needless(ring[kept - 2], ring[kept - 1], ring[first]))
      --kept, changed = true;
    else if (needless(ring[kept - 1], ring[first], ring[first + 1]))
      ++first, changed = true;
  }
  if (kept - first < 3) kept = first = 0;
  ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(kept), ring.end());
  ring.erase(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(first));
}

void drop_collinear_of_line(Polyline& line) {
  std::size_t kept = 0;
  for (const Point p : line) {
    if (kept >= 1 && line[kept - 1] == p) continue;
    // A line may turn back on itself: only a point between its neighbours goes.
    while (kept >= 2 && needless(line[kept - 2], line[kept - 1], p) &&
           dot(line[kept - 1] - line[kept - 2], p - line[kept - 1]) > 0)
      --kept;
    line[kept++] = p;
  }
  line.resize(kept);
}

Polyline simplified_line(std::span<const Point> line, Um bound) {
  if (line.size() < 3 || bound <= 0) return {line.begin(), line.end()};
  // Where a line steps back, as at a gap that was closed, the chord goes on to the first point beyond, if that is not
  // far.
  constexpr std::size_t most_short = 8;
  Polyline out{line[0]};
  Cone cone(line[0], bound);
  std::size_t end = 0;  // of the chord, as far as it is known
  for (std::size_t i = 1; end + 1 < line.size();) {
    const auto verdict = i < line.size() ? cone.of(line[i]) : Cone::Verdict::leaves_some;
    if (verdict == Cone::Verdict::passes) end = i;
    if (verdict == Cone::Verdict::passes || (verdict == Cone::Verdict::ends_short && i - end <= most_short)) {
      cone.see(line[i++]);
      continue;
    }
    out.push_back(line[end]);
    cone = Cone(line[end], bound);
    i = end + 1;
  }
  out.push_back(line.back());
  return out;
}

namespace {

/// Begins and ends at an extreme point: it is on the hull wherever the ring begins, and moves with the ring.
Polyline opened_at_extreme(const Ring& ring) {
  const auto start = std::min_element(ring.begin(), ring.end());
  Polyline out(start, ring.end());
  out.insert(out.end(), ring.begin(), start + 1);
  return out;
}

}  // namespace

Ring coarsened(const Ring& ring, Um bound) {
  if (ring.size() <= 3 || bound <= 0) return ring;
  Ring out = simplified_line(opened_at_extreme(ring), bound);
  out.pop_back();
  return out.size() >= 3 ? out : ring;
}

Regions coarsened(const Regions& regions, Um bound) {
  Regions out;
  for (const Region& region : regions) {
    Region& to = out.emplace_back(Region{coarsened(region.outer, bound), {}});
    for (const Ring& hole : region.holes) to.holes.push_back(coarsened(hole, bound));
  }
  return out;
}

Ring simplified(const Ring& ring, Um bound) {
  if (ring.size() <= 3 || bound <= 0) return ring;
  const Polyline opened = opened_at_extreme(ring);
  const double area = static_cast<double>(double_area(ring));
  for (; bound > 0; bound = bound * 3 / 4) {
    Ring out = simplified_line(opened, bound);
    out.pop_back();
    const double off = static_cast<double>(double_area(out)) - area;
    if (out.size() >= 3 && std::abs(off) <= most_area_share * std::abs(area)) return out;
  }
  return ring;
}

Regions simplified(const Regions& regions, Um bound) {
  Regions out = regions;
  for (auto& region : out) {
    stop_if_asked();
    region.outer = simplified(region.outer, bound);
    for (auto& hole : region.holes) hole = simplified(hole, bound);
  }
  const auto convex = [](const Region& region) { return region.holes.empty() && runs_round_convex(region.outer); };
  if (std::all_of(regions.begin(), regions.end(), convex)) return out;  // chords lie within what was apart
  // Each round gives a ring its points back; when all have theirs, nothing crosses.
  const auto shortened = [&] {
    std::vector<std::pair<const Ring*, Ring*>> pairs;  // as they were, and as they are
    for (std::size_t r = 0; r < out.size(); ++r) {
      pairs.emplace_back(&regions[r].outer, &out[r].outer);
      for (std::size_t h = 0; h < out[r].holes.size(); ++h) pairs.emplace_back(&regions[r].holes[h], &out[r].holes[h]);
    }
    return pairs;
  }();
  const auto is_short = [](const auto& ring) { return ring.first->size() != ring.second->size(); };
  for (bool crossed = std::any_of(shortened.begin(), shortened.end(), is_short); crossed;) {
    crossed = false;
    const auto rings = rings_of(out);
    const RingEdges edges(rings);
    for (const auto& [i, j] : edges.crossing_pairs())
      for (const std::uint32_t edge : {i, j}) {
        const auto& ring = shortened[edges.ring_of(edge)];
        if (!is_short(ring)) continue;
        *ring.second = *ring.first;
        crossed = true;
      }
  }
  return out;
}

}  // namespace weft::geometry
