// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/delaunay.h"

#include <algorithm>

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

namespace weft::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;  // corners are integers: nothing is constructed
using Vertices = CGAL::Triangulation_vertex_base_with_info_2<std::size_t, Kernel>;
using Delaunay = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<Vertices>>;

}  // namespace

std::vector<std::array<std::size_t, 3>> delaunay(std::span<const Point> points) {
  Delaunay built;
  Delaunay::Face_handle near;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto before = built.number_of_vertices();
    const auto vertex = built.insert(Kernel::Point_2(points[i].x, points[i].y), near);
    if (built.number_of_vertices() > before) vertex->info() = i;
    near = vertex->face();
  }
  std::vector<std::array<std::size_t, 3>> out;
  for (const auto face : built.finite_face_handles()) {
    std::array<std::size_t, 3> triangle{face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()};
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    out.push_back(triangle);
  }
  std::sort(out.begin(), out.end());
  return out;
}

}  // namespace weft::geometry
