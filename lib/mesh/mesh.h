// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace weft {

/// Corners as indices of vertices, counter-clockwise seen from outside.
using Triangle = std::array<std::uint32_t, 3>;

/// A triangle mesh on the lattice. Welded: no two vertices are equal. After mesh::read no triangle has a corner twice,
/// and every vertex is one's corner. Not promised: that it is closed, that it is free of self-intersections, that a
/// triangle has an area (three corners in a line are kept: without them their neighbours would have open edges).
struct Mesh {
  std::vector<Point3> vertices;
  std::vector<Triangle> triangles;
  bool cut_through =
      false;  ///< a shell that is inside out cuts through another: what runs clockwise adds nothing anywhere
  friend bool operator==(const Mesh&, const Mesh&) = default;
};

/// An axis-aligned box in space; empty when min > max.
struct Box3 {
  Point3 min{max_coord, max_coord, max_coord}, max{-max_coord, -max_coord, -max_coord};
  friend constexpr bool operator==(const Box3&, const Box3&) = default;
  constexpr bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
  constexpr Point3 size() const { return {max.x - min.x, max.y - min.y, max.z - min.z}; }
  constexpr Box footprint() const { return {flat(min), flat(max)}; }
  constexpr void add(Point3 p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
  }
  constexpr void add(const Box3& other) {
    if (!other.empty()) add(other.min), add(other.max);
  }
  /// Whether `inner` lies in this box; their faces may touch.
  constexpr bool contains(const Box3& inner) const {
    return inner.min.x >= min.x && inner.max.x <= max.x && inner.min.y >= min.y && inner.max.y <= max.y &&
           inner.min.z >= min.z && inner.max.z <= max.z;
  }
};

/// The box of the vertices.
Box3 box_of(const Mesh& mesh);

/// The convex hull of the vertices seen from above, as of convex_hull.
Ring footprint_of(const Mesh& mesh);

/// Enclosed volume, mm³, voids counted off; negative when the mesh is inside out. Of an open mesh: about what it would
/// be if every hole were closed towards the centre of its box.
double volume_mm3(const Mesh& mesh);

/// Six times the signed volume of the tetrahedron between `from` and the triangle abc, µm³.
inline double six_volumes_um3(Point3 from, Point3 a, Point3 b, Point3 c) {
  const double ax = a.x - from.x, ay = a.y - from.y, az = a.z - from.z;
  const double bx = b.x - from.x, by = b.y - from.y, bz = b.z - from.z;
  const double cx = c.x - from.x, cy = c.y - from.y, cz = c.z - from.z;
  return ax * (by * cz - bz * cy) + ay * (bz * cx - bx * cz) + az * (bx * cy - by * cx);
}

}  // namespace weft
