// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/notice.h"
#include "mesh/mesh.h"

#include <cstddef>
#include <string>

namespace weft::mesh {

/// What was mended in a mesh, and what was found and left as it is.
struct Repairs {
  std::size_t degenerate = 0;          ///< triangles dropped because two of their corners are one
  std::size_t duplicates = 0;          ///< triangles dropped because another has the same corners
  std::size_t sheets = 0;              ///< triangles dropped because they lie back to back and enclose nothing
  std::size_t flipped = 0;             ///< triangles turned round to agree with the rest of their shell
  std::size_t inverted_shells = 0;     ///< closed shells that were inside out as a whole and were turned round
  std::size_t shells = 0;              ///< pieces of surface connected through edges that two triangles share
  std::size_t open_edges = 0;          ///< left: edges with one triangle, the rims of holes
  std::size_t non_manifold_edges = 0;  ///< left: edges where three or more triangles meet
  std::size_t one_sided_shells = 0;    ///< left: shells that cannot be oriented (a Möbius strip)

  friend bool operator==(const Repairs&, const Repairs&) = default;
  /// Whether the mesh differs from the file's in more than its rounding to microns.
  bool changed() const { return duplicates + sheets + flipped + inverted_shells > 0; }
  bool watertight() const { return open_edges + non_manifold_edges + one_sided_shells == 0; }
};

/// One notice for each kind of repair or oddity, with its number: "mesh_open_edges", "part.stl: 12 edges are open ...".
/// @param of the object, as the user should read it
Notices notices_of(const Repairs& repairs, const std::string& of);

struct Repaired {
  Mesh mesh;
  Repairs repairs;
};

/// Pre: `mesh` is welded.
Repaired repair(Mesh mesh);

}  // namespace weft::mesh
