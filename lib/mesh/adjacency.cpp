// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/adjacency.h"

#include "tasks/parallel.h"

namespace weft::mesh {
namespace {

struct Found {
  std::vector<std::uint32_t> open, twins, one_sided;
  std::vector<Edges::Side> crowded;
  std::vector<std::size_t> crowded_ends;
};

Found look_at(std::span<const Edges::Side> sides, ShellForest& shells) {
  Found found;
  for_each_edge(sides, [&](std::span<const Edges::Side> edge) {
    const std::uint32_t first = edge.front().triangle(), last = edge.back().triangle();
    if (edge.size() == 1) {
      found.open.push_back(first);
    } else if (edge.size() == 2) {
      if (!shells.unite(first, last, edge.front().upward() != edge.back().upward())) found.one_sided.push_back(first);
      if (edge.front().apex == edge.back().apex) found.twins.insert(found.twins.end(), {first, last});
    } else {
      found.crowded.insert(found.crowded.end(), edge.begin(), edge.end());
      found.crowded_ends.push_back(found.crowded.size());
    }
  });
  return found;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

}  // namespace

Adjacency adjacency_of(const Mesh& mesh) {
  const Edges edges(mesh);
  Adjacency out{ShellForest(mesh.triangles.size()), {}, {}, {}, {}, {}};
  const auto look = [&](std::size_t range) { return look_at(edges.sides(range), out.shells); };
  tasks::parallel_in_order(edges.ranges(), look, [&](std::size_t, const Found& found) {
    append(out.open, found.open);
    append(out.twins, found.twins);
    append(out.one_sided, found.one_sided);
    for (const std::size_t end : found.crowded_ends) out.crowded_ends.push_back(out.crowded.size() + end);
    append(out.crowded, found.crowded);
  });
  return out;
}

}  // namespace weft::mesh
