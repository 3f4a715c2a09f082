// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/mesh.h"
#include "mesh/weld.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace weft::mesh {

/// A piece of a model; corners are numbers of vertices of its own.
struct Part {
  Weld weld{0};
  std::vector<Triangle> triangles{};
};

/// How a model is read piece by piece.
struct PartReader {
  std::size_t parts = 0;
  std::size_t most_triangles = 0;  ///< of all parts together: room that is not used is address space, no memory
  std::size_t expected_vertices = 0;
  /// Fetches what part i is made of, in order, one at a time. Of all parts on their way at once it has a place of its
  /// own, from 0 to tasks::most_in_flight() - 1.
  std::function<void(std::size_t i, std::size_t place)> fetch = [](std::size_t, std::size_t) {};
  /// Reads it, side by side with others.
  std::function<void(std::size_t i, std::size_t place, Part& part)> read;
};

/// The parts in one mesh, the same whatever the threads: triangles in order, vertices numbered as they appear in it.
/// Within a part most corners are repeated, so that few places are left to be welded one part after the other. Throws:
/// the error of the first part that has one.
Mesh welded(const PartReader& reader);

}  // namespace weft::mesh
