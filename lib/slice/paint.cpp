// SPDX-License-Identifier: GPL-3.0-or-later
#include "slice/paint.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/clip_lines.h"
#include "geometry/offset.h"
#include "slice/shadow.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace weft::slice {
namespace {

/// The distances that are told apart.
constexpr int steps = 30;
/// Outlines are simplified: so far from a painted facet's cut they are still painted.
constexpr Um on_outline = 40;
/// Half the width of a line as a region.
constexpr Um hair = 1;

using Segment = std::pair<Point, Point>;

/// Where the facets cross a plane.
std::vector<std::vector<Segment>> crossings(const Mesh& facets, std::span<const Plane> planes) {
  std::vector<std::vector<Segment>> out(planes.size());
  StopNowAndThen now_and_then(256);
  for (const Triangle& t : facets.triangles) {
    now_and_then.step();
    const Point3 corners[] = {facets.vertices[t[0]], facets.vertices[t[1]], facets.vertices[t[2]]};
    const auto [low, high] = std::minmax({corners[0].z, corners[1].z, corners[2].z});
    const auto first =
        std::partition_point(planes.begin(), planes.end(), [&low = low](const Plane& p) { return p.below < low; });
    for (auto plane = first; plane != planes.end() && plane->below < high; ++plane) {
      const double z = plane->below + 0.5;  // no vertex lies there
      std::vector<Point> ends;
      for (std::size_t i = 0; i < 3; ++i) {
        const Point3 a = corners[i], b = corners[(i + 1) % 3];
        if ((a.z < z) == (b.z < z)) continue;
        const double share = (z - a.z) / static_cast<double>(b.z - a.z);
        ends.push_back({a.x + rounded(share * static_cast<double>(b.x - a.x)),
                        a.y + rounded(share * static_cast<double>(b.y - a.y))});
      }
      if (ends.size() == 2 && ends[0] != ends[1])
        out[static_cast<std::size_t>(plane - planes.begin())].emplace_back(ends[0], ends[1]);
    }
  }
  return out;
}

/// The line as a region, as thin as can be.
Region thin(Point a, Point b) {
  const double length = distance(a, b);
  const auto across = [&](double d) { return length > 0 ? rounded(d * hair / length) : hair; };
  const Point side{-across(b.y - a.y), across(b.x - a.x)};
  Ring ring{a - side, b - side, b + side, a + side};
  if (double_area(ring) < 0) std::reverse(ring.begin(), ring.end());
  return {std::move(ring), {}};
}

Regions around(const Regions& lines, Um by) {
  return lines.empty() ? Regions{}
                       : geometry::offset(lines, {.by = by, .corner = geometry::Corner::round, .arc_tolerance = 20});
}

Regions thin_lines(const std::vector<Segment>& segments) {
  Regions out;
  for (const auto& [a, b] : segments) out.push_back(thin(a, b));
  return out;
}

/// The outline where nothing is painted.
Regions unpainted(const Regions& outline, const Regions& all_paint) {
  std::vector<Polyline> lines;
  for (const auto& ring : geometry::rings_of(outline)) {
    lines.emplace_back(ring.begin(), ring.end());
    lines.back().push_back(ring.front());
  }
  Regions out;
  for (const auto& piece : geometry::clip_lines(lines, around(all_paint, on_outline), geometry::Keep::outside))
    for (std::size_t i = 1; i < piece.line.size(); ++i)
      if (distance(piece.line.front(), piece.line.back()) > 2 * on_outline || piece.line.size() > 3)
        out.push_back(thin(piece.line[i - 1], piece.line[i]));
  return out;
}

/// What is nearer to `own` than to `others`, and no farther than `depth`.
Regions nearer(const Regions& own, const Regions& others, Um depth) {
  Regions out;
  for (int i = 1; i <= steps; ++i) {
    const Um by = std::max<Um>(1, depth * i / steps);
    auto piece = around(own, by);
    if (!others.empty()) piece = geometry::subtract(piece, around(others, by));
    out.insert(out.end(), std::make_move_iterator(piece.begin()), std::make_move_iterator(piece.end()));
  }
  return geometry::unite(out);
}

/// Facets that look up, or down.
Mesh facing(const Mesh& facets, bool up) {
  Mesh out = facets;
  std::erase_if(out.triangles, [&](const Triangle& t) {
    const Point3 a = facets.vertices[t[0]], b = facets.vertices[t[1]], c = facets.vertices[t[2]];
    const double z = static_cast<double>(b.x - a.x) * static_cast<double>(c.y - a.y) -
                     static_cast<double>(b.y - a.y) * static_cast<double>(c.x - a.x);
    return up ? z <= 0 : z >= 0;
  });
  return out;
}

/// What lies below painted roofs, or above painted floors, of each layer.
std::vector<Regions> reached(const Mesh& facets, std::span<const Plane> planes, Um reach, bool up) {
  std::vector<Regions> out(planes.size());
  const auto own = facing(facets, up);
  if (own.triangles.empty() || reach <= 0) return out;
  std::vector<Plane> with_top(planes.begin(), planes.end());
  with_top.push_back({max_coord, 0, max_coord});  // roofs above the last cut
  const auto seen = shadows(own, with_top);
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i].empty()) continue;
    // A roof between two cuts is the top of the lower one's layer.
    const auto first = static_cast<std::ptrdiff_t>(i) - (up ? 1 : 0);
    for (auto j = first; j >= 0 && j < static_cast<std::ptrdiff_t>(planes.size()); j += up ? -1 : 1) {
      const auto& here = planes[static_cast<std::size_t>(j)];
      const auto& from = planes[static_cast<std::size_t>(std::max<std::ptrdiff_t>(first, 0))];
      if (std::abs(here.z - from.z) >= reach) break;
      auto& to = out[static_cast<std::size_t>(j)];
      to.insert(to.end(), seen[i].begin(), seen[i].end());
    }
  }
  return out;
}

}  // namespace

std::vector<std::vector<Regions>> painted(std::span<const Mesh> painted, std::span<const Plane> planes,
                                          std::span<const Regions> outlines, PaintReach reach) {
  const std::size_t count = painted.size();
  std::vector<std::vector<std::vector<Segment>>> cut;
  std::vector<std::vector<Regions>> roofs, floors;
  for (const Mesh& mesh : painted) {
    cut.push_back(crossings(mesh, planes));
    roofs.push_back(reached(mesh, planes, reach.roof, true));
    floors.push_back(reached(mesh, planes, reach.floor, false));
  }
  std::vector<std::vector<Regions>> out(count, std::vector<Regions>(planes.size()));
  for (std::size_t i = 0; i < planes.size() && i < outlines.size(); ++i) {
    stop_if_asked();
    std::vector<Regions> lines;
    Regions all;
    for (std::size_t k = 0; k < count; ++k) {
      lines.push_back(thin_lines(cut[k][i]));
      all.insert(all.end(), lines[k].begin(), lines[k].end());
    }
    const auto bare = all.empty() ? Regions{} : unpainted(outlines[i], all);
    Regions taken;
    for (std::size_t k = 0; k < count; ++k) {
      Regions own;
      if (!lines[k].empty()) {
        Regions others = bare;
        for (std::size_t m = 0; m < count; ++m)
          if (m != k) others.insert(others.end(), lines[m].begin(), lines[m].end());
        own = nearer(lines[k], others, reach.depth);
      }
      for (const auto* flat : {&roofs[k][i], &floors[k][i]}) own.insert(own.end(), flat->begin(), flat->end());
      if (own.empty()) continue;
      own = geometry::subtract(geometry::intersect(own, outlines[i]), taken);
      taken.insert(taken.end(), own.begin(), own.end());
      out[k][i] = std::move(own);
    }
  }
  return out;
}

}  // namespace weft::slice
