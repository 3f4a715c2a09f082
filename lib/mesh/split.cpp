// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/disjoint_sets.h"
#include "mesh/adjacency.h"
#include "mesh/transform.h"
#include "mesh/weld.h"

#include <algorithm>

namespace weft::mesh {
namespace {

struct Shell {
  Box3 box;
  double six_um3 = 0;
};

double volume_of(const Box3& box) {
  const Point3 size = box.size();
  return double(size.x) * size.y * size.z;
}

bool apart(const Box3& a, const Box3& b) {
  return a.max.x <= b.min.x || b.max.x <= a.min.x || a.max.y <= b.min.y || b.max.y <= a.min.y || a.max.z <= b.min.z ||
         b.max.z <= a.min.z;
}

/// The body that a shell which faces inward is a hole of; itself where there is none.
std::size_t body_around(const std::vector<Shell>& shells, std::size_t hole, bool cut_through) {
  std::size_t best = hole;
  for (std::size_t s = 0; s < shells.size(); ++s)
    if (shells[s].six_um3 > 0 && shells[s].box.contains(shells[hole].box) &&
        (best == hole || volume_of(shells[s].box) < volume_of(shells[best].box)))
      best = s;
  for (std::size_t s = 0; s < shells.size() && best == hole && cut_through; ++s)
    if (shells[s].six_um3 > 0 && !apart(shells[s].box, shells[hole].box)) best = s;
  return best;
}

}  // namespace

std::vector<Mesh> split(const Mesh& mesh) {
  auto adjacency = adjacency_of(mesh);
  const std::size_t count = adjacency.shells.number_shells();
  DisjointSets groups(count);
  for (std::size_t begin = 0, i = 0; i < adjacency.crowded_ends.size(); begin = adjacency.crowded_ends[i++])
    for (std::size_t side = begin + 1; side < adjacency.crowded_ends[i]; ++side)
      groups.join(adjacency.shells.shell(adjacency.crowded[begin].triangle()),
                  adjacency.shells.shell(adjacency.crowded[side].triangle()));
  std::vector<Shell> shells(count);
  const auto shell_of = [&](std::size_t t) { return groups.of(adjacency.shells.shell(t)); };
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t corner : mesh.triangles[t]) shells[shell_of(t)].box.add(mesh.vertices[corner]);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    auto& shell = shells[shell_of(t)];
    const auto& [a, b, c] = mesh.triangles[t];
    shell.six_um3 += six_volumes_um3(shell.box.min, mesh.vertices[a], mesh.vertices[b], mesh.vertices[c]);
  }
  for (std::size_t s = 0; s < count; ++s)
    if (groups.of(s) == s && shells[s].six_um3 < 0) groups.join(s, body_around(shells, s, mesh.cut_through));
  std::vector<std::size_t> body(count, count);
  std::vector<Mesh> out;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::size_t root = shell_of(t);
    if (body[root] == count) {
      body[root] = out.size();
      out.emplace_back().cut_through = mesh.cut_through;
    }
    out[body[root]].triangles.push_back(mesh.triangles[t]);
  }
  if (out.size() == 1) return {mesh};
  std::vector<std::uint32_t> index(mesh.vertices.size());
  for (Mesh& part : out) {
    constexpr std::uint32_t none = ~std::uint32_t{0};
    for (const Triangle& t : part.triangles)
      for (const std::uint32_t v : t) index[v] = none;
    for (Triangle& t : part.triangles)
      for (std::uint32_t& v : t) {
        if (index[v] == none) {
          index[v] = static_cast<std::uint32_t>(part.vertices.size());
          part.vertices.push_back(mesh.vertices[v]);
        }
        v = index[v];
      }
  }
  return out;
}

}  // namespace weft::mesh
