// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "mesh/facings.h"

#include <map>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

namespace weft::mesh {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;  // corners are integers: nothing is constructed
using Corner = Kernel::Point_3;

}  // namespace

Hull hull_of(const Mesh& mesh) {
  stop_if_asked();
  CGAL::Surface_mesh<Corner> built;
  std::vector<Corner> points;
  points.reserve(mesh.vertices.size());
  for (const Point3 p : mesh.vertices) points.emplace_back(p.x, p.y, p.z);
  CGAL::convex_hull_3(points.begin(), points.end(), built);
  Hull out;
  const auto point_of = [&](auto vertex) {
    const Corner& p = built.point(vertex);
    return Point3{static_cast<Um>(p.x()), static_cast<Um>(p.y()), static_cast<Um>(p.z())};
  };
  for (const auto vertex : built.vertices()) out.corners.push_back(point_of(vertex));
  std::map<CGAL::Surface_mesh<Corner>::Vertex_index, std::uint32_t> number;
  for (const auto vertex : built.vertices()) number.emplace(vertex, static_cast<std::uint32_t>(number.size()));
  for (const auto face : built.faces()) {
    std::vector<std::uint32_t> ring;
    for (const auto vertex : built.vertices_around_face(built.halfedge(face))) ring.push_back(number.at(vertex));
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) out.triangles.push_back({ring[0], ring[i], ring[i + 1]});
  }
  return out;
}

}  // namespace weft::mesh
