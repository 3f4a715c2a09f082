// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/holes_below.h"

#include "mesh/transform.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace weft::mesh {
namespace {

/// Which vertices hang together through triangles: the first of each shell stands for it.
std::vector<std::uint32_t> shells_of(const Mesh& mesh) {
  std::vector<std::uint32_t> of(mesh.vertices.size());
  std::iota(of.begin(), of.end(), 0U);
  const auto root = [&](std::uint32_t v) {
    while (of[v] != v) v = of[v] = of[of[v]];
    return v;
  };
  for (const auto& t : mesh.triangles)
    for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) {
      const auto a = root(t[0]), b = root(t[i]);
      of[std::max(a, b)] = std::min(a, b);
    }
  for (std::uint32_t v = 0; v < of.size(); ++v) of[v] = root(v);
  return of;
}

}  // namespace

Mesh without_holes_below(Mesh mesh) {
  if (!mesh.cut_through) return mesh;
  const auto shell = shells_of(mesh);
  std::vector<double> volume(mesh.vertices.size(), 0);
  const Point3 middle = mesh.vertices.front();
  for (const auto& [a, b, c] : mesh.triangles)
    volume[shell[a]] += six_volumes_um3(middle, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
  Um lowest = max_coord, lowest_of_all = max_coord;
  for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
    lowest_of_all = std::min(lowest_of_all, mesh.vertices[v].z);
    if (volume[shell[v]] > 0) lowest = std::min(lowest, mesh.vertices[v].z);
  }
  if (lowest == max_coord || lowest <= lowest_of_all) return mesh;
  Mesh out = cut_at(mesh, lowest).upper;
  out.cut_through = true;
  return out;
}

}  // namespace weft::mesh
