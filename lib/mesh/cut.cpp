// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "mesh/face_delaunay.h"
#include "mesh/transform.h"
#include "mesh/weld.h"

#include <algorithm>
#include <map>
#include <utility>

namespace weft::mesh {
namespace {

/// Half of a mesh as it comes about.
class Half {
 public:
  Half(std::size_t vertices, bool upper) : weld_(vertices / 2 + 16), upper_(upper) {}

  void add(Point3 a, Point3 b, Point3 c) { triangles_.push_back({weld_.index(a), weld_.index(b), weld_.index(c)}); }
  /// A side of a triangle that lies in the cut, as that triangle has it.
  void add_rim(Point3 from, Point3 to) {
    if (!(from == to)) rims_.emplace_back(weld_.index(to), weld_.index(from));  // as the lid has it
  }

  Mesh take(bool cut_through) && {
    close();
    Mesh out;
    out.vertices = weld_.take_vertices(), out.triangles = std::move(triangles_), out.cut_through = cut_through;
    drop_degenerate(out);
    drop_unused_vertices(out);
    return out;
  }

 private:
  /// Closed rings of rims; chains that do not close are left out.
  std::vector<std::vector<std::uint32_t>> rings() {
    std::multimap<std::uint32_t, std::uint32_t> next(rims_.begin(), rims_.end());
    std::vector<std::vector<std::uint32_t>> out;
    while (!next.empty()) {
      stop_if_asked();
      std::vector<std::uint32_t> chain{next.begin()->first};
      std::map<std::uint32_t, std::size_t> at{{chain.front(), 0}};
      while (!chain.empty()) {
        const auto step = next.find(chain.back());
        if (step == next.end()) {  // it ends here
          at.erase(chain.back());
          chain.pop_back();
          continue;
        }
        const std::uint32_t to = step->second;
        next.erase(step);
        if (const auto met = at.find(to); met != at.end()) {
          const auto begin = chain.begin() + static_cast<std::ptrdiff_t>(met->second);
          if (chain.end() - begin > 2) out.emplace_back(begin, chain.end());
          for (auto v = begin + 1; v != chain.end(); ++v) at.erase(*v);
          chain.erase(begin + 1, chain.end());
          if (next.count(chain.back()) == 0 && chain.size() == 1) break;
          continue;
        }
        at.emplace(to, chain.size());
        chain.push_back(to);
      }
    }
    return out;
  }

  void close() {
    std::vector<std::vector<Point>> outlines;
    std::vector<std::uint32_t> corners;
    for (const auto& ring : rings()) {
      auto& outline = outlines.emplace_back();
      for (const std::uint32_t v : ring) outline.push_back(flat(weld_.vertices()[v])), corners.push_back(v);
    }
    if (outlines.empty()) return;
    if (const auto lid = triangulated_rings(outlines)) {
      for (Triangle t : *lid) {
        if (upper_) std::swap(t[1], t[2]);
        triangles_.push_back({corners[t[0]], corners[t[1]], corners[t[2]]});
      }
      return;
    }
    // Rounded outlines may cross each other by a micron: fans are closed, too.
    std::size_t first = 0;
    for (const auto& outline : outlines) {
      for (std::size_t i = 1; i + 1 < outline.size(); ++i)
        triangles_.push_back({corners[first], corners[first + i], corners[first + i + 1]});
      first += outline.size();
    }
  }

  Weld weld_;
  bool upper_;
  std::vector<Triangle> triangles_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> rims_;
};

/// Where the edge from a lower to an upper vertex meets the height. The same whichever triangle asks.
Point3 crossing(Point3 low, Point3 high, Um z) {
  const double t = (double(z) - low.z) / (double(high.z) - low.z);
  return {low.x + rounded(t * (double(high.x) - low.x)), low.y + rounded(t * (double(high.y) - low.y)), z};
}

}  // namespace

Halves cut_at(const Mesh& mesh, Um z) {
  Half lower(mesh.vertices.size(), false), upper(mesh.vertices.size(), true);
  StopNowAndThen stop(4096);
  for (const Triangle& t : mesh.triangles) {
    stop.step();
    std::array<Point3, 3> p{mesh.vertices[t[0]], mesh.vertices[t[1]], mesh.vertices[t[2]]};
    const auto is_low = [&](const Point3& q) { return q.z < z; };
    const auto low = std::count_if(p.begin(), p.end(), is_low);
    if (low == 3) lower.add(p[0], p[1], p[2]);
    if (low == 0) upper.add(p[0], p[1], p[2]);
    if (low == 0 || low == 3) continue;
    // The one that is alone comes first.
    while (is_low(p[0]) != (low == 1)) std::rotate(p.begin(), p.begin() + 1, p.end());
    const bool alone_low = low == 1;
    const auto cut = [&](Point3 other) { return alone_low ? crossing(p[0], other, z) : crossing(other, p[0], z); };
    const Point3 b = cut(p[1]), c = cut(p[2]);
    Half &one = alone_low ? lower : upper, &two = alone_low ? upper : lower;
    one.add(p[0], b, c), one.add_rim(b, c);
    two.add(b, p[1], p[2]), two.add(b, p[2], c), two.add_rim(c, b);
  }
  return {std::move(lower).take(mesh.cut_through), std::move(upper).take(mesh.cut_through)};
}

}  // namespace weft::mesh
