// SPDX-License-Identifier: GPL-3.0-or-later
#include "plate/silhouette.h"

#include "geometry/boolean.h"

#include <map>
#include <utility>
#include <vector>

namespace weft::plate {

Regions silhouette_of(std::span<const Mesh> meshes) {
  std::vector<Ring> rings;
  for (const auto& mesh : meshes) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;  // directed, of triangles that face up
    for (const auto& t : mesh.triangles) {
      const Point a = flat(mesh.vertices[t[0]]), b = flat(mesh.vertices[t[1]]), c = flat(mesh.vertices[t[2]]);
      if (orient(a, b, c) <= 0) continue;
      for (std::size_t i = 0; i < 3; ++i) {
        const auto from = t[i], to = t[(i + 1) % 3];
        if (const auto other = edges.find({to, from}); other != edges.end() && other->second > 0)
          --other->second;
        else
          ++edges[{from, to}];
      }
    }
    std::map<std::uint32_t, std::vector<std::uint32_t>> next;
    for (const auto& [edge, count] : edges)
      for (int i = 0; i < count; ++i) next[edge.first].push_back(edge.second);
    while (!next.empty()) {  // at each vertex as many edges begin as end
      Ring ring;
      const std::uint32_t first = next.begin()->first;
      for (std::uint32_t at = first;;) {
        const auto out = next.find(at);
        if (out == next.end()) break;
        ring.push_back(flat(mesh.vertices[at]));
        at = out->second.back();
        out->second.pop_back();
        if (out->second.empty()) next.erase(out);
        if (at == first) break;
      }
      if (ring.size() > 2) rings.push_back(std::move(ring));
    }
  }
  return geometry::regions_from_rings(rings, geometry::WindingRule::nonzero);
}

}  // namespace weft::plate
