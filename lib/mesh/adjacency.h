// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/edges.h"
#include "mesh/shell_forest.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace weft::mesh {

/// What the edges of a mesh say of its triangles.
struct Adjacency {
  ShellForest shells;                       ///< triangles that share an edge with exactly one other, joined
  std::vector<std::uint32_t> open;          ///< the triangle of each edge that has but one
  std::vector<Edges::Side> crowded;         ///< of edges of three or more triangles, edge by edge
  std::vector<std::size_t> crowded_ends{};  ///< where in `crowded` each such edge ends
  std::vector<std::uint32_t> twins;         ///< triangles that share an edge with one other, which has the same corners
  std::vector<std::uint32_t> one_sided;     ///< some triangle of each shell that has no orientation
};

/// Cost: as of Edges.
Adjacency adjacency_of(const Mesh& mesh);

}  // namespace weft::mesh
