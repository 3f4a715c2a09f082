// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/mesh.h"

#include <array>
#include <cstddef>
#include <vector>

namespace weft::mesh {

/// Corners of the convex hull. Cost: n log n.
/// Source: Barber, Dobkin, Huhdanpaa 1996, "The Quickhull algorithm for convex hulls" (CGAL).
struct Hull {
  std::vector<Point3> corners;
  std::vector<Triangle> triangles;  ///< counter-clockwise seen from outside
};
Hull hull_of(const Mesh& mesh);

/// A way to lay a mesh on the bed: that direction down.
struct Facing {
  std::array<double, 3> down{0, 0, -1};  ///< of length 1
  double mm2 = 0;                        ///< of the facets that made it a candidate
};

/// Which ways a mesh may be laid: the file's own first, then the largest facets of its convex hull, on which it can
/// rest, and its largest flat areas, largest first; directions nearer than 3° are one. At most 1 + hull + flat.
/// Law: deterministic. Cost: linear in triangles.
std::vector<Facing> facings_of(const Mesh& mesh, const Hull& around, std::size_t hull, std::size_t flat);

/// What the facets say of one way to lay it, without slicing.
struct Laid {
  double steep_mm2 = 0;  ///< of facets that lean out further than the angle, but for those on the bed
  double steep_mm3 = 0;  ///< by their height above the bed
  double foot_mm2 = 0;   ///< of facets on the bed
  double height_mm = 0;
};

/// The facets of a mesh, to be asked. Cost of a question: linear.
class Facets {
 public:
  Facets(const Mesh& mesh, const Hull& around);
  /// @param degrees from vertical
  Laid laid(const std::array<double, 3>& down, double degrees) const;

 private:
  struct Facet {
    std::array<float, 3> normal, centre;  ///< mm
    float mm2;
  };
  std::vector<Facet> facets_;
  std::vector<Point3> outmost_;
};

}  // namespace weft::mesh
