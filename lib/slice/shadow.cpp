// SPDX-License-Identifier: GPL-3.0-or-later
#include "slice/shadow.h"

#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/offset.h"

#include <algorithm>
#include <array>
#include <limits>

namespace weft::slice {
namespace {

using Corner = std::array<double, 3>;

/// The side of a convex polygon where sign · z >= sign · at.
std::vector<Corner> cut_off(const std::vector<Corner>& polygon, double at, double sign) {
  std::vector<Corner> out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Corner &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double da = sign * (a[2] - at), db = sign * (b[2] - at);
    if (da >= 0) out.push_back(a);
    if ((da > 0 && db < 0) || (da < 0 && db > 0)) {
      const double t = da / (da - db);
      out.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), at});
    }
  }
  return out;
}

}  // namespace

std::vector<Regions> shadows(const Mesh& facets, std::span<const Plane> planes) {
  constexpr Um rounding = 10;  // pieces of neighbouring facets meet
  std::vector<std::vector<Ring>> rings(planes.size());
  StopNowAndThen now_and_then(256);
  for (const Triangle& t : facets.triangles) {
    now_and_then.step();
    std::vector<Corner> whole;
    Um low = max_coord, high = -max_coord;
    for (const auto v : t) {
      const Point3 p = facets.vertices[v];
      whole.push_back({double(p.x), double(p.y), double(p.z)});
      low = std::min(low, p.z), high = std::max(high, p.z);
    }
    const auto first =
        std::partition_point(planes.begin(), planes.end(), [&](const Plane& p) { return p.below < low; });
    for (auto plane = first; plane != planes.end(); ++plane) {
      const double from =
          plane == planes.begin() ? std::numeric_limits<double>::lowest() : std::prev(plane)->below + 0.5;
      if (from > high) break;
      auto piece = cut_off(cut_off(whole, from, 1), plane->below + 0.5, -1);
      if (piece.size() < 3) continue;
      Ring ring;
      for (const Corner& c : piece) ring.push_back({rounded(c[0]), rounded(c[1])});
      if (double_area(ring) < 0) std::reverse(ring.begin(), ring.end());
      if (double_area(ring) > 0) rings[static_cast<std::size_t>(plane - planes.begin())].push_back(std::move(ring));
    }
  }
  std::vector<Regions> out(planes.size());
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (!rings[i].empty()) out[i] = geometry::offset(geometry::regions_from_rings(rings[i]), {.by = rounding});
  return out;
}

}  // namespace weft::slice
