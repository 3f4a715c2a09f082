// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/nest.h"

#include "core/convex_hull.h"
#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "geometry/simplify.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

namespace weft::pipeline {
namespace {

using namespace weft::literals;

constexpr std::size_t most_corners = 80;  // of an outline: no-fit polygons cost their product
constexpr std::size_t most_placed = 10'000;

bool is_convex(const Ring& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (orient(ring[i], ring[(i + 1) % ring.size()], ring[(i + 2) % ring.size()]) < 0) return false;
  return true;
}

Ring turned_round(Ring ring) {
  for (Point& p : ring) p = -p;
  return ring;
}

/// Fewer corners, and never smaller: widened by as much as simplifying may cut off.
std::vector<Ring> rings_of(const Regions& outline, Um by) {
  std::vector<Ring> out;
  for (Um bound = 100;; bound *= 2) {
    out.clear();
    std::size_t corners = 0;
    const auto wide = geometry::offset(
        outline, {.by = by + bound, .corner = geometry::Corner::round, .miter_limit = 2, .arc_tolerance = bound});
    for (const auto& region : geometry::simplified(wide, bound)) {
      out.push_back(region.outer);
      corners += region.outer.size();
    }
    if (corners <= most_corners || bound > 10_mm) return out;
  }
}

/// Where a shape may be with all its corners in a convex surface.
Regions inside_of(const Ring& convex_surface, const std::vector<Ring>& shape) {
  std::vector<Point> corners;
  for (const auto& ring : shape) corners.insert(corners.end(), ring.begin(), ring.end());
  Regions out;
  for (const Point corner : convex_hull(std::move(corners))) {
    Ring moved = convex_surface;
    for (Point& p : moved) p = p - corner;
    out = out.empty() ? Regions{{std::move(moved), {}}} : geometry::intersect(out, {{std::move(moved), {}}});
    if (out.empty()) return out;
  }
  return out;
}

/// Shapes that are placed, and what forbids what.
class Nest {
 public:
  Nest(std::span<const NestKind> kinds, const NestBed& bed) : kinds_(kinds), bed_(bed) {
    for (const auto& kind : kinds) {
      small_.push_back(rings_of(kind.outline, bed.beside));
      wide_.push_back(rings_of(kind.outline, bed.beside + bed.spacing));
    }
    const Ring hull = convex_hull({bed.surface.begin(), bed.surface.end()});
    Regions obstacles = geometry::subtract({{hull, {}}}, {{bed.surface, {}}});
    for (const auto& ring : bed.keep_out) obstacles.push_back({ring, {}});
    at_first_ = tasks::parallel_map(kinds.size(), [&](std::size_t k) {
      Regions free = inside_of(hull, small_[k]), forbidden;
      for (const auto& obstacle : obstacles)
        for (const auto& shape : small_[k])
          for (auto& region : no_fit(obstacle.outer, shape)) forbidden.push_back(std::move(region));
      return forbidden.empty() ? free : geometry::subtract(free, forbidden);
    });
  }

  enum class Way { middle_out, from_below };
  std::vector<std::vector<Point>> run(Way way) {
    free_ = at_first_;
    std::vector<std::vector<Point>> out(kinds_.size());
    std::vector<std::size_t> order(kinds_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return area_mm2(kinds_[a].outline) > area_mm2(kinds_[b].outline);
    });
    for (const std::size_t k : order)
      for (std::size_t i = 0; i < kinds_[k].copies && put(k, way, out); ++i) {
      }
    std::size_t placed = 0;
    for (bool any = true; any && placed < most_placed;) {
      any = false;
      for (const std::size_t k : order)
        if (kinds_[k].copies == 0 && put(k, way, out)) any = true, ++placed;
    }
    return out;
  }

 private:
  bool put(std::size_t k, Way way, std::vector<std::vector<Point>>& out) {
    stop_if_asked();
    const auto at = best(free_[k], way);
    if (!at) return false;
    out[k].push_back(*at);
    forbid(k, *at);
    return true;
  }
  std::optional<Point> best(const Regions& free, Way way) const {
    if (free.empty()) return std::nullopt;
    const auto rank = [&](Point p) {
      return way == Way::middle_out ? std::tuple(distance2(p, bed_.middle), std::int64_t{p.y}, std::int64_t{p.x})
                                    : std::tuple(std::int64_t{p.y}, std::int64_t{p.x}, std::int64_t{0});
    };
    std::optional<Point> out;
    const auto offer = [&](Point p) {
      if (!out || rank(p) < rank(*out)) out = p;
    };
    for (const auto& region : free) {
      for (const Point p : region.outer) offer(p);
      for (const auto& hole : region.holes)
        for (const Point p : hole) offer(p);
      const bool in = side_of(region.outer, bed_.middle) == Side::inside &&
                      std::all_of(region.holes.begin(), region.holes.end(),
                                  [&](const Ring& hole) { return side_of(hole, bed_.middle) == Side::outside; });
      if (in && way == Way::middle_out) offer(bed_.middle);
    }
    return out;
  }
  void forbid(std::size_t placed, Point at) {
    const auto made = tasks::parallel_map(kinds_.size(), [&](std::size_t k) {
      return free_[k].empty() ? Regions{} : geometry::subtract(free_[k], moved(no_fit_of(placed, k), at));
    });
    free_ = made;
  }
  /// Each pair once.
  const Regions& no_fit_of(std::size_t placed, std::size_t k) {
    auto& known = pairs_[placed * kinds_.size() + k];
    if (!known) {
      Regions all;
      for (const auto& a : wide_[placed])
        for (const auto& b : small_[k])
          for (auto& region : no_fit(a, b)) all.push_back(std::move(region));
      known = geometry::unite(all);
    }
    return *known;
  }

  std::span<const NestKind> kinds_;
  const NestBed& bed_;
  std::vector<std::vector<Ring>> small_, wide_;  ///< by kind: as it lies, and with the spacing around it
  std::vector<Regions> at_first_, free_;         ///< by kind, where it may be
  std::vector<std::optional<Regions>> pairs_ = std::vector<std::optional<Regions>>(kinds_.size() * kinds_.size());
};

std::size_t count_of(const std::vector<std::vector<Point>>& places) {
  std::size_t out = 0;
  for (const auto& kind : places) out += kind.size();
  return out;
}

}  // namespace

Regions silhouette_of(std::span<const Mesh> meshes) {
  std::vector<Ring> rings;
  for (const auto& mesh : meshes) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;  // directed, of triangles that face up
    for (const auto& t : mesh.triangles) {
      const Point a = flat(mesh.vertices[t[0]]), b = flat(mesh.vertices[t[1]]), c = flat(mesh.vertices[t[2]]);
      if (orient(a, b, c) <= 0) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto from = t[i], to = t[(i + 1) % 3];
        if (const auto other = edges.find({to, from}); other != edges.end() && other->second > 0)
          --other->second;
        else
          ++edges[{from, to}];
      }
    }
    std::map<std::uint32_t, std::vector<std::uint32_t>> next;
    for (const auto& [edge, count] : edges)
      for (int i = 0; i < count; ++i) next[edge.first].push_back(edge.second);
    while (!next.empty()) {  // at each vertex as many edges begin as end
      Ring ring;
      const std::uint32_t first = next.begin()->first;
      for (std::uint32_t at = first;;) {
        const auto out = next.find(at);
        if (out == next.end()) break;
        ring.push_back(flat(mesh.vertices[at]));
        at = out->second.back();
        out->second.pop_back();
        if (out->second.empty()) next.erase(out);
        if (at == first) break;
      }
      if (ring.size() > 2) rings.push_back(std::move(ring));
    }
  }
  return geometry::regions_from_rings(rings, geometry::WindingRule::nonzero);
}

Regions no_fit(const Ring& a, const Ring& b) {
  const Ring c = turned_round(b);
  if (is_convex(a) && is_convex(c)) {
    std::vector<Point> corners;
    for (const Point p : a)
      for (const Point q : c) corners.push_back(p + q);
    return {{convex_hull(std::move(corners)), {}}};
  }
  std::vector<Ring> swept;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t j = 0; j < c.size(); ++j) {
      const Point p = a[i], q = a[(i + 1) % a.size()], u = c[j], v = c[(j + 1) % c.size()];
      Ring quad{p + u, q + u, q + v, p + v};
      if (double_area(quad) < 0) std::reverse(quad.begin(), quad.end());
      if (double_area(quad) != 0) swept.push_back(std::move(quad));
    }
  Regions out = geometry::regions_from_rings(swept, geometry::WindingRule::nonzero);
  for (auto& region : out) region.holes.clear();
  return geometry::unite(out);
}

std::vector<std::vector<Point>> nest(std::span<const NestKind> kinds, const NestBed& bed) {
  Nest nest(kinds, bed);
  const bool fills = std::any_of(kinds.begin(), kinds.end(), [](const NestKind& kind) { return kind.copies == 0; });
  std::size_t asked = 0;
  for (const auto& kind : kinds) asked += kind.copies;
  auto out = nest.run(Nest::Way::middle_out);
  if (!fills && count_of(out) == asked) return out;
  auto other = nest.run(Nest::Way::from_below);
  return count_of(other) > count_of(out) ? other : out;
}

}  // namespace weft::pipeline
