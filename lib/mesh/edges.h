#pragma once
#include "mesh/mesh.h"

#include <cstdint>
#include <vector>

namespace weft::mesh {

/// Who meets whom at the edges of a mesh. A side is a triangle's edge: side 3t + i goes from corner i of triangle t to
/// the next one.
struct EdgeTable {
  /// Of each side: the one side it shares its edge with.
  struct Neighbour {
    std::uint32_t side : 31;
    std::uint32_t agrees : 1;  ///< it runs the other way, as in a well-oriented surface
  };
  static constexpr std::uint32_t none = 0x7fffffff;     ///< an open edge
  static constexpr std::uint32_t several = 0x7ffffffe;  ///< an edge of three or more triangles

  std::vector<Neighbour> neighbours;
  std::size_t open_edges = 0;
  std::vector<std::uint32_t> crowded_sides;  ///< sides of edges of three or more triangles, edge by edge
  std::vector<std::size_t> crowded_ends;     ///< where in crowded_sides each such edge ends
};

/// Pre: no triangle has a corner twice; fewer than 2^28 triangles.
/// Cost: linear but for vertices of very many edges, which are sorted; 8 bytes a side and 4 a vertex.
EdgeTable edges_of(const Mesh& mesh);

}  // namespace weft::mesh
