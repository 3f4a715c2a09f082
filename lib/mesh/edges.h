// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace weft::mesh {

/// Who meets whom at the edges of a mesh: the sides of its triangles, by ranges of vertices, so that ranges can be
/// looked at side by side. Refers to the mesh.
class Edges {
 public:
  /// A triangle at an edge.
  struct Side {
    std::uint32_t lower, upper;      ///< the edge's vertices
    std::uint32_t apex;              ///< the triangle's third one
    std::uint32_t triangle_and_way;  ///< 2 * triangle + whether its side leaves from the lower vertex
    std::uint32_t triangle() const { return triangle_and_way >> 1; }
    bool upward() const { return triangle_and_way & 1; }
  };

  /// Pre: no triangle has a corner twice; fewer than 2^28 triangles. Cost: linear; 4 bytes a side.
  explicit Edges(const Mesh& mesh);

  std::size_t ranges() const { return starts_.size() - 1; }

  /// The sides of a range edge by edge: in order of the lower, then of the upper vertex, then of triangles. Ranges are
  /// in order of the lower vertex. Cost: linear but for vertices of very many edges, which are sorted. Thread: any
  /// number at once.
  std::vector<Side> sides(std::size_t range) const;

 private:
  const Mesh& mesh_;
  int range_bits_;                    ///< so many lowest bits of a vertex tell it within its range
  std::vector<std::size_t> starts_;   ///< of each range in sides_, and one more
  std::vector<std::uint32_t> sides_;  ///< 4 * triangle + the corner that the side leaves from
};

/// edge(sides) for each edge, in order.
template <class F>
void for_each_edge(std::span<const Edges::Side> sides, F edge) {
  for (std::size_t from = 0, to = 0; from < sides.size(); from = to) {
    while (to < sides.size() && sides[to].lower == sides[from].lower && sides[to].upper == sides[from].upper) ++to;
    edge(sides.subspan(from, to - from));
  }
}

}  // namespace weft::mesh
