// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/weld.h"

namespace weft::mesh {

/// Each vertex where f puts it. Post: welded, no triangle has a corner twice.
template <class F>
Mesh mapped(Mesh mesh, F f) {
  Weld weld(mesh.vertices.size());
  std::vector<std::uint32_t> welded;
  welded.reserve(mesh.vertices.size());
  for (const Point3& p : mesh.vertices) welded.push_back(weld.index(f(p)));
  for (Triangle& triangle : mesh.triangles)
    for (std::uint32_t& corner : triangle) corner = welded[corner];
  mesh.vertices = weld.take_vertices();
  if (drop_degenerate(mesh) > 0) drop_unused_vertices(mesh);
  return mesh;
}

}  // namespace weft::mesh
