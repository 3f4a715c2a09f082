// SPDX-License-Identifier: GPL-3.0-or-later
#include "slice/paint.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "geometry/spatial_index.h"
#include "slice/nearest_run.h"
#include "slice/shadow.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace weft::slice {
namespace {

/// Outlines are simplified, and holes in the mesh closed: so far from a painted facet's cut they are still painted.
constexpr double on_outline_um = 40;

/// Regions that are no farther apart touch.
constexpr Um beside = 5;

bool apart(const Region& a, const Regions& b) {
  const Box around = box_of(a.outer).grown(beside);
  Regions near;
  for (const Region& region : b)
    if (around.overlaps(box_of(region.outer))) near.push_back(region);
  return near.empty() || geometry::intersect(geometry::offset({a}, {.by = beside}), near).empty();
}

/// What is left over goes to the first paint that it touches.
void give(Regions rests, std::vector<Regions>& paints) {
  std::vector<Regions> given(paints.size());
  for (Region& rest : rests)
    for (std::size_t k = 0; k < paints.size(); ++k) {
      if (apart(rest, paints[k])) continue;
      given[k].push_back(std::move(rest));
      break;
    }
  for (std::size_t k = 0; k < paints.size(); ++k)
    if (!given[k].empty()) paints[k] = geometry::unite(paints[k], given[k]);
}

/// Is more of a region farther than `by` from its outline than could be nearer? A band along an outline is at most as
/// large as its length, and the sectors round its reflex corners, make it.
bool surely_wider(const Region& region, double by) {
  double left = static_cast<double>(double_area(region.outer)) / 2;
  const auto take = [&](const Ring& ring) {
    for (std::size_t i = 0, n = ring.size(); i < n; ++i) {
      const Point a = ring[i], b = ring[(i + 1) % n], c = ring[(i + 2) % n];
      const Point u = b - a, v = c - b;
      const double cross = static_cast<double>(u.x) * v.y - static_cast<double>(u.y) * v.x;
      const double dot = static_cast<double>(u.x) * v.x + static_cast<double>(u.y) * v.y;
      left -= distance(a, b) * by + std::max(0.0, -std::atan2(cross, dot)) * by * by / 2;
    }
  };
  take(region.outer);
  for (const Ring& hole : region.holes) {
    left += static_cast<double>(double_area(hole)) / 2;  // negative
    take(hole);
  }
  return left > 0;
}

/// Where an edge of the mesh crosses a height, whichever way it is run through.
Point crossing(Point3 a, Point3 b, double z) {
  if (b < a) std::swap(a, b);
  const double share = (z - a.z) / static_cast<double>(b.z - a.z);
  return {a.x + rounded(share * static_cast<double>(b.x - a.x)), a.y + rounded(share * static_cast<double>(b.y - a.y))};
}

/// Facets that look up, or down, and lie so flat that what is below them within `reach` is farther from the outline
/// than `depth`: of steeper ones that is painted anyway.
Mesh facing(const Mesh& facets, bool up, PaintReach reach, Um through) {
  Mesh out{facets.vertices, {}};
  const double steepest = static_cast<double>(through) / static_cast<double>(reach.depth);
  for (const Triangle& t : facets.triangles) {
    const Point3 a = facets.vertices[t[0]], b = facets.vertices[t[1]], c = facets.vertices[t[2]];
    const double ux = b.x - a.x, uy = b.y - a.y, uz = b.z - a.z, vx = c.x - a.x, vy = c.y - a.y, vz = c.z - a.z;
    const double x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;  // its normal
    if ((up ? z > 0 : z < 0) && std::hypot(x, y) <= steepest * std::abs(z)) out.triangles.push_back(t);
  }
  return out;
}

}  // namespace

Paint::Paint(std::span<const Mesh> painted, std::span<const Plane> planes, PaintReach reach)
    : planes_(planes), reach_(reach) {
  for (const Mesh& mesh : painted) {
    cuts_.push_back(crossings(mesh));
    flats_.push_back(reached(mesh, reach.roof, true));
    auto floors = reached(mesh, reach.floor, false);
    for (std::size_t i = 0; i < floors.size(); ++i)
      flats_.back()[i].insert(flats_.back()[i].end(), floors[i].begin(), floors[i].end());
  }
}

std::vector<std::vector<Paint::Segment>> Paint::crossings(const Mesh& facets) const {
  std::vector<std::vector<Segment>> out(planes_.size());
  StopNowAndThen now_and_then(256);
  for (const Triangle& t : facets.triangles) {
    now_and_then.step();
    const Point3 corners[] = {facets.vertices[t[0]], facets.vertices[t[1]], facets.vertices[t[2]]};
    const auto [low, high] = std::minmax({corners[0].z, corners[1].z, corners[2].z});
    auto plane =
        std::partition_point(planes_.begin(), planes_.end(), [&low = low](const Plane& p) { return p.below < low; });
    for (; plane != planes_.end() && plane->below < high; ++plane) {
      const double z = plane->below + 0.5;  // no vertex lies there
      std::vector<Point> ends;
      for (std::size_t i = 0; i < 3; ++i) {
        const Point3 a = corners[i], b = corners[(i + 1) % 3];
        if ((a.z < z) != (b.z < z)) ends.push_back(crossing(a, b, z));
      }
      if (ends.size() == 2 && ends[0] != ends[1])
        out[static_cast<std::size_t>(plane - planes_.begin())].push_back({ends[0], ends[1]});
    }
  }
  return out;
}

/// What lies below painted roofs, or above painted floors, of each layer.
std::vector<Regions> Paint::reached(const Mesh& facets, Um reach, bool up) const {
  std::vector<Regions> out(planes_.size());
  const auto own = facing(facets, up, reach_, reach);
  if (own.triangles.empty() || reach <= 0) return out;
  std::vector<Plane> with_top(planes_.begin(), planes_.end());
  with_top.push_back({max_coord, 0, max_coord});  // roofs above the last cut
  const auto seen = shadows(own, with_top);
  const auto count = static_cast<std::ptrdiff_t>(planes_.size());
  for (std::ptrdiff_t i = 0; i <= count; ++i) {
    const auto& shadow = seen[static_cast<std::size_t>(i)];
    if (shadow.empty()) continue;
    // A roof between two cuts is the top of the lower one's layer.
    const auto first = i - (up ? 1 : 0);
    for (auto j = first; j >= 0 && j < count; j += up ? -1 : 1) {
      const auto& here = planes_[static_cast<std::size_t>(j)];
      const auto& from = planes_[static_cast<std::size_t>(std::max<std::ptrdiff_t>(first, 0))];
      if (std::abs(here.z - from.z) >= reach) break;
      auto& to = out[static_cast<std::size_t>(j)];
      to.insert(to.end(), shadow.begin(), shadow.end());
    }
  }
  return out;
}

bool Paint::touches(std::size_t i) const {
  for (std::size_t k = 0; k < cuts_.size(); ++k)
    if (i < planes_.size() && (!cuts_[k][i].empty() || !flats_[k][i].empty())) return true;
  return false;
}

std::vector<Regions> Paint::areas(std::size_t i, const Regions& outline) const {
  const std::size_t count = cuts_.size();
  std::vector<Regions> own(count);
  std::vector<geometry::Segment> segments;
  std::vector<int> paint_of;
  std::map<Point, int> ends;  // where a chain of cuts begins or ends, an odd number of them do
  std::vector<Point> borders;
  bool flat = false;
  for (std::size_t k = 0; k < count; ++k) {
    ends.clear();
    for (const auto& [a, b] : cuts_[k][i]) {
      segments.push_back({a, b}), paint_of.push_back(static_cast<int>(k));
      ++ends[a], ++ends[b];
    }
    for (const auto& [at, times] : ends)
      if (times % 2 != 0) borders.push_back(at);
    flat = flat || !flats_[k][i].empty();
  }
  if (!segments.empty()) {
    const geometry::SegmentIndex index(std::move(segments));
    const auto kind_at = [&](Point p) {
      const auto nearest = index.nearest(p, on_outline_um);
      return nearest ? paint_of[nearest->segment] : static_cast<int>(count);
    };
    for (const Region& region : outline) add_near(region, borders, kind_at, own);
  }
  if (flat) add_flat(i, outline, own);
  return own;
}

/// What is nearest to painted outline of a region, no deeper than paint goes.
void Paint::add_near(const Region& region, std::span<const Point> borders, const std::function<int(Point)>& kind_at,
                     std::vector<Regions>& own) const {
  const std::size_t bare = own.size();  // the kind of outline without paint
  auto cells = nearest_to(region, static_cast<int>(bare) + 1, borders, reach_.depth, kind_at);
  if (cells.empty()) return;
  bool any = false;
  for (std::size_t k = 0; k < bare; ++k) {
    any = any || !cells[k].empty();
    std::erase_if(cells[k], [&](const Region& piece) { return is_narrow(piece); });
    std::move(cells[k].begin(), cells[k].end(), std::back_inserter(own[k]));
  }
  if (!any) return;
  // Nothing could be printed of what is narrow between paints: it goes with one of them.
  auto& rests = cells[bare];
  std::erase_if(rests, [&](const Region& rest) { return !is_narrow(rest); });
  if (rests.empty()) return;
  const geometry::SegmentIndex outline(geometry::rings_of({region}));
  const auto deep = [&](Point p) { return !outline.nearest(p, reach_.depth - beside); };
  std::erase_if(rests, [&](const Region& rest) { return std::any_of(rest.outer.begin(), rest.outer.end(), deep); });
  give(std::move(rests), own);
}

/// What lies below painted roofs and above painted floors, as far as it is not another paint's.
void Paint::add_flat(std::size_t i, const Regions& outline, std::vector<Regions>& own) const {
  Regions taken;
  for (std::size_t k = 0; k < own.size(); ++k) {
    own[k].insert(own[k].end(), flats_[k][i].begin(), flats_[k][i].end());
    if (own[k].empty()) continue;
    own[k] = geometry::intersect(geometry::subtract(own[k], taken), outline);
    std::erase_if(own[k], [&](const Region& region) { return is_narrow(region); });
    taken.insert(taken.end(), own[k].begin(), own[k].end());
  }
  if (taken.empty()) return;
  auto rests = geometry::subtract(outline, taken);
  std::erase_if(rests, [&](const Region& rest) { return !is_narrow(rest); });
  give(std::move(rests), own);
}

bool Paint::is_narrow(const Region& region) const {
  const Um within = reach_.least / 2;
  return reach_.least > 0 && !surely_wider(region, within) && geometry::offset({region}, {.by = -within}).empty();
}

}  // namespace weft::slice
