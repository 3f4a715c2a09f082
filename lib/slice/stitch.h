// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "mesh/mesh.h"
#include "slice/slice.h"

#include <cstdint>
#include <span>
#include <vector>

/// From the triangles that a plane cuts to closed rings; private to slice/.
namespace weft::slice {

struct Chains {
  std::vector<Ring> rings;     ///< solid on the left; may cross and touch
  std::vector<Polyline> open;  ///< where triangles are missing; at least one point
};

/// Follows the cut from triangle to triangle over the edges that they share: by the identity of the edges, never by
/// coordinates. Where more than two triangles share an edge any pairing gives closed rings with the same winding
/// numbers.
Chains stitch(const Mesh& mesh, std::span<const std::uint32_t> triangles, Um below);

/// Joins the ends of open chains, nearest pairs first, until all are rings.
void close(Chains& chains, Gaps& closed, Gaps& bridged);

}  // namespace weft::slice
