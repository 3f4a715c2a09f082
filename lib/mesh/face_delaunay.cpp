// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/face_delaunay.h"

#include "core/stop.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <utility>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

namespace weft::mesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;  // corners are integers: nothing is constructed
enum class Side : std::uint8_t { unknown, outside, inside };
using Vertices = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Faces =
    CGAL::Triangulation_face_base_with_info_2<Side, Kernel, CGAL::Constrained_triangulation_face_base_2<Kernel>>;
using Delaunay =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertices, Faces>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Edge = std::pair<std::uint32_t, std::uint32_t>;
using Points = std::vector<std::pair<Kernel::Point_2, std::uint32_t>>;

constexpr unsigned now_and_then = 64;  // corners, of a microsecond or two

Edge edge_of(std::uint32_t a, std::uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

/// Inside is what an odd number of sides separates from the plane around: a side that is gone to and fro separates
/// nothing.
/// @return false where a side runs over a corner, and is cut there
bool tell_sides(Delaunay& delaunay, const std::map<Edge, unsigned>& uses) {
  std::vector<Delaunay::Face_handle> open{delaunay.infinite_face()};
  open.front()->info() = Side::outside;
  StopNowAndThen stop(now_and_then);
  while (!open.empty()) {
    stop.step();
    const auto face = open.back();
    open.pop_back();
    for (int i = 0; i < 3; ++i) {
      const auto next = face->neighbor(i);
      if (next->info() != Side::unknown) continue;
      bool across = false;
      if (face->is_constrained(i)) {
        const auto at =
            uses.find(edge_of(face->vertex(Delaunay::cw(i))->info(), face->vertex(Delaunay::ccw(i))->info()));
        if (at == uses.end()) return false;
        across = at->second % 2 == 1;
      }
      next->info() = across == (face->info() == Side::outside) ? Side::inside : Side::outside;
      open.push_back(next);
    }
  }
  return true;
}

/// Along a curve that fills the plane: no step is far from the one before.
void insert(Delaunay& delaunay, Points points) {
  using First = CGAL::First_of_pair_property_map<Points::value_type>;
  CGAL::spatial_sort(points.begin(), points.end(), CGAL::Spatial_sort_traits_adapter_2<Kernel, First>());
  StopNowAndThen stop(now_and_then);
  Delaunay::Face_handle near;
  for (const auto& [point, index] : points) {
    stop.step();
    const auto vertex = delaunay.insert(point, near);
    vertex->info() = index;
    near = vertex->face();
  }
}

/// The triangles that lie in an odd number of rings.
std::optional<std::vector<Triangle>> triangles_inside(const std::vector<const std::vector<Point>*>& rings) {
  Points points;
  for (const auto* ring : rings)
    for (const Point p : *ring)
      points.emplace_back(Kernel::Point_2(p.x, p.y), static_cast<std::uint32_t>(points.size()));
  Delaunay delaunay;
  insert(delaunay, points);
  std::map<Kernel::Point_2, Delaunay::Vertex_handle> seen;
  for (const auto vertex : delaunay.finite_vertex_handles()) seen.emplace(vertex->point(), vertex);
  std::vector<Delaunay::Vertex_handle> corners;
  corners.reserve(points.size());
  for (const auto& [point, index] : points) corners.push_back(seen.at(point));
  std::map<Edge, unsigned> uses;
  StopNowAndThen stop(now_and_then);
  std::size_t first = 0;
  try {
    for (const auto* ring : rings) {
      for (std::size_t i = 0; i < ring->size(); ++i) {
        stop.step();
        const auto a = corners[first + i], b = corners[first + (i + 1) % ring->size()];
        if (a == b) return std::nullopt;
        delaunay.insert_constraint(a, b);
        ++uses[edge_of(a->info(), b->info())];
      }
      first += ring->size();
    }
  } catch (const Delaunay::Intersection_of_constraints_exception&) {
    return std::nullopt;
  }
  for (const auto face : delaunay.all_face_handles()) face->info() = Side::unknown;
  if (!tell_sides(delaunay, uses)) return std::nullopt;
  std::vector<Triangle> triangles;
  triangles.reserve(points.size());
  for (const auto face : delaunay.finite_face_handles())
    if (face->info() == Side::inside)
      triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
  return triangles;
}

}  // namespace

std::optional<std::vector<Triangle>> triangulated_by_delaunay(const std::vector<Point>& ring) {
  auto triangles = triangles_inside({&ring});
  if (triangles && triangles->size() + 2 != ring.size()) return std::nullopt;
  return triangles;
}

std::optional<std::vector<Triangle>> triangulated_rings(const std::vector<std::vector<Point>>& rings) {
  std::vector<const std::vector<Point>*> all;
  for (const auto& ring : rings) all.push_back(&ring);
  return triangles_inside(all);
}

}  // namespace weft::mesh
