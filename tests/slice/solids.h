// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/mesh.h"

#include <algorithm>

/// Meshes made of boxes, for laws.
namespace solids {
using namespace weft;

/// Adds a box; a void when turned inside out.
inline void add_box(Mesh& mesh, Point3 min, Point3 max, bool inside_out = false) {
  const auto base = static_cast<std::uint32_t>(mesh.vertices.size());
  for (unsigned k = 0; k < 8; ++k)
    mesh.vertices.push_back({k & 1 ? max.x : min.x, k & 2 ? max.y : min.y, k & 4 ? max.z : min.z});
  constexpr std::array<std::array<std::uint32_t, 4>, 6> faces{
      {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}};
  for (const auto& f : faces)
    for (Triangle t : {Triangle{f[0], f[1], f[2]}, Triangle{f[0], f[2], f[3]}}) {
      for (auto& corner : t) corner += base;
      if (inside_out) std::swap(t[1], t[2]);
      mesh.triangles.push_back(t);
    }
}

inline Mesh box(Point3 min, Point3 max) {
  Mesh mesh;
  add_box(mesh, min, max);
  return mesh;
}

inline Mesh moved(Mesh mesh, Point3 by) {
  for (auto& v : mesh.vertices) v = {v.x + by.x, v.y + by.y, v.z + by.z};
  return mesh;
}

}  // namespace solids
