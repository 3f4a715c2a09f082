// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/clipper_door.h"

#include "core/stop.h"
#include "geometry/heaps.h"
#include "geometry/nesting.h"
#include "geometry/ring_edges.h"
#include "geometry/simplify.h"
#include "geometry/sweep.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <stdexcept>
#include <utility>

namespace weft::geometry::clipper {
namespace {
using ClipperLib::cInt;

ClipperLib::ClipType type_of(Operation operation) {
  switch (operation) {
    case Operation::unite:
      return ClipperLib::ctUnion;
    case Operation::intersect:
      return ClipperLib::ctIntersection;
    case Operation::subtract:
      return ClipperLib::ctDifference;
    case Operation::exclusive_or:
      return ClipperLib::ctXor;
  }
  return ClipperLib::ctUnion;
}

ClipperLib::PolyFillType fill_of(WindingRule rule) {
  switch (rule) {
    case WindingRule::nonzero:
      return ClipperLib::pftNonZero;
    case WindingRule::positive:
      return ClipperLib::pftPositive;
    case WindingRule::even_odd:
      return ClipperLib::pftEvenOdd;
  }
  return ClipperLib::pftNonZero;
}

std::int64_t nearest_quotient(std::int64_t value, std::int64_t divisor) {
  const std::int64_t shifted = 2 * value + divisor;  // floor((2v + d) / 2d): the same step everywhere on the line
  const std::int64_t quotient = shifted / (2 * divisor);
  return shifted % (2 * divisor) < 0 ? quotient - 1 : quotient;
}

/// Whether anything was added: Clipper refuses rings without area, and fails when it has none at all.
bool add(ClipperLib::Clipper& sweep, const FineRings& rings, ClipperLib::PolyType type, std::int64_t coarser) {
  bool added = false;
  ClipperLib::Path path;
  for (const auto& ring : rings) {
    path.clear();
    if (coarser == 1)
      for (const auto p : ring) path.emplace_back(p.x, p.y);
    else
      for (const auto p : ring) path.emplace_back(nearest_quotient(p.x, coarser), nearest_quotient(p.y, coarser));
    added |= sweep.AddPath(path, type, true);
  }
  return added;
}

Point coarse(std::int64_t x, std::int64_t y, Point origin) {
  return origin + Point{static_cast<Um>(nearest_quotient(x, steps)), static_cast<Um>(nearest_quotient(y, steps))};
}

/// The contours on the lattice, without those that the rounding left no area.
std::vector<Ring> settled(const ClipperLib::Paths& contours, std::int64_t coarser, Point origin) {
  std::vector<Ring> out;
  out.reserve(contours.size());
  for (const auto& contour : contours) {
    Ring ring;
    ring.reserve(contour.size());
    for (const auto& p : contour) ring.push_back(coarse(p.X * coarser, p.Y * coarser, origin));
    drop_collinear(ring);
    if (!ring.empty()) out.push_back(std::move(ring));
  }
  return out;
}

/// What each of several operations leaves of one input. Outers counter-clockwise, holes clockwise.
using Results = std::vector<std::vector<Ring>>;

/// Not as Clipper's tree: the time to build that grows with the square of the number of crossings.
Results swept_at_once(std::span<const Operation> operations, WindingRule rule, const FineRings& subject,
                      const FineRings& clip, Point origin) {
  // Clipper gives up when rounding contradicts its sweep order: very rare, and another grid has other roundings.
  for (const std::int64_t coarser : {1, 3, 16, 160}) {
    stop_if_asked();
    try {
      Sweep sweep;
      const bool any_subject = add(sweep, subject, ClipperLib::ptSubject, coarser);
      const bool any_clip = add(sweep, clip, ClipperLib::ptClip, coarser);
      if (!any_subject && !any_clip) return Results(operations.size());
      Results out;
      ClipperLib::Paths contours;
      for (const auto operation : operations)
        if (sweep.Execute(type_of(operation), contours, fill_of(rule), fill_of(rule)))
          out.push_back(settled(contours, coarser, origin));
      if (out.size() == operations.size()) return out;
    } catch (const ClipperLib::clipperException&) {
    }
  }
  stop_if_asked();
  throw std::logic_error("geometry: a polygon Boolean failed on every grid");
}

/// As one sweep finds them, from the highest y down.
void sort_as_swept(std::vector<Ring>& rings) {
  std::vector<std::pair<Point, std::size_t>> order;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const Point top = *std::max_element(rings[i].begin(), rings[i].end(),
                                        [](Point a, Point b) { return a.y != b.y ? a.y < b.y : a.x > b.x; });
    order.push_back({{-top.y, top.x}, i});
  }
  std::sort(order.begin(), order.end());
  std::vector<Ring> out;
  out.reserve(rings.size());
  for (const auto& [at, i] : order) out.push_back(std::move(rings[i]));
  rings = std::move(out);
}

Results swept(std::span<const Operation> operations, WindingRule rule, const FineRings& subject, const FineRings& clip,
              Point origin) {
  constexpr std::size_t many = 256;
  if (subject.size() + clip.size() <= many) return swept_at_once(operations, rule, subject, clip, origin);
  Results out(operations.size());
  for (const Heap& heap : heaps_of(subject, clip)) {
    const auto [subjects, clips] = heap.input();
    auto parts = swept_at_once(operations, rule, subjects, clips, origin);
    for (std::size_t k = 0; k < out.size(); ++k)
      std::copy_if(std::move_iterator(parts[k].begin()), std::move_iterator(parts[k].end()), std::back_inserter(out[k]),
                   [&](const Ring& ring) { return !heap.is_frame(ring, origin); });
  }
  for (auto& rings : out) sort_as_swept(rings);
  return out;
}

/// The rings, with a corner at each crossing (to the nearest micron) on both edges that cross there.
FineRings split(std::span<const Ring> rings, const RingEdges& edges,
                const std::vector<std::pair<std::uint32_t, std::uint32_t>>& pairs, Point origin) {
  struct Corner {
    std::uint32_t edge;
    double along;
    Point at;
  };
  std::vector<Corner> corners;
  for (const auto& [i, j] : pairs) {
    const Segment s = edges.edge(i), t = edges.edge(j);
    const auto share = [](const Segment& of, const Segment& by) {
      const auto a = static_cast<double>(orient(by.a, by.b, of.a)), b = static_cast<double>(orient(by.a, by.b, of.b));
      return a / (a - b);
    };
    const Point at = lerp(s.a, s.b, share(s, t));
    corners.push_back({i, share(s, t), at});
    corners.push_back({j, share(t, s), at});
  }
  std::sort(corners.begin(), corners.end(),
            [](const Corner& l, const Corner& r) { return l.edge != r.edge ? l.edge < r.edge : l.along < r.along; });
  const auto fine = [&](Point p) {
    return FinePoint{(std::int64_t{p.x} - origin.x) * steps, (std::int64_t{p.y} - origin.y) * steps};
  };
  FineRings out;
  auto next = corners.begin();
  std::uint32_t edge = 0;
  for (const Ring& ring : rings) {
    FineRing& to = out.emplace_back();
    for (const Point p : ring) {
      to.push_back(fine(p));
      for (; next != corners.end() && next->edge == edge; ++next) to.push_back(fine(next->at));
      ++edge;
    }
  }
  return out;
}

}  // namespace

Ring coarse(const FineRing& ring, Point origin) {
  Ring out;
  out.reserve(ring.size());
  for (const auto p : ring) out.push_back(coarse(p.x, p.y, origin));
  drop_collinear(out);
  return out;
}

Regions tidied(std::vector<Ring> rings, Point origin) {
  if (auto alone = convex_alone(rings)) return *std::move(alone);
  // Rounding to whole microns can push a corner through an edge close by. Then both get a corner where they cross, and
  // what that turned over is united away. Nearly always once is enough.
  constexpr int most_rounds = 4;
  for (int round = 0;; ++round) {
    const RingEdges edges(rings);
    const auto pairs = edges.crossing_pairs();
    if (pairs.empty() || round == most_rounds) return nested_by_orientation(rings, edges);
    constexpr Operation unite[] = {Operation::unite};
    rings = std::move(swept(unite, WindingRule::positive, split(rings, edges, pairs, origin), {}, origin).front());
  }
}
std::vector<Regions> run(std::span<const Operation> operations, WindingRule rule, const FineRings& subject,
                         const FineRings& clip, Point origin) {
  std::vector<Regions> out;
  for (auto& rings : swept(operations, rule, subject, clip, origin)) out.push_back(tidied(std::move(rings), origin));
  return out;
}

Regions run(Operation operation, WindingRule rule, const FineRings& subject, const FineRings& clip, Point origin) {
  return std::move(run(std::span(&operation, 1), rule, subject, clip, origin).front());
}

}  // namespace weft::geometry::clipper
