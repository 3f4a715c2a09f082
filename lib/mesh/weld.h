// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/mesh.h"

#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace weft::mesh {

/// No coordinate of a model may lie further from the origin. NaN and infinity are not placeable either.
inline constexpr double max_coordinate_mm = 16'000;
inline bool placeable(double mm) {
  return std::abs(mm) <= max_coordinate_mm;
}

/// The nearest micron, ties upward, so that moving a model by whole microns moves every vertex by just as much.
/// Pre: placeable(mm).
inline Um lattice(double mm) {
  constexpr Um up = max_coord;  // makes the number positive, where cutting off the fraction is rounding down
  return static_cast<Um>(mm * 1000.0 + (up + 0.5)) - up;
}

/// Gives equal points equal indices, in the order of their first appearance: what a mesh is built with.
/// Cost: O(1) a point on average; open addressing, at most half full, 4 bytes a slot.
class Weld {
 public:
  /// `expected` vertices need no regrowth of the table; more are fine.
  explicit Weld(std::size_t expected);

  std::uint32_t index(Point3 p) {
    for (std::size_t slot = hash(p) >> shift_;; slot = (slot + 1) & mask_) {
      const std::uint32_t found = slots_[slot];
      if (found == vacant) return insert(p, slot);
      if (vertices_[found] == p) return found;
    }
  }

  /// Of each of the points, as `index` one after the other would give them, but what a slot holds is fetched ahead.
  std::vector<std::uint32_t> indices(std::span<const Point3> points);

  std::span<const Point3> vertices() const { return vertices_; }
  std::vector<Point3> take_vertices() { return std::move(vertices_); }
  /// Forgets all points, not the room for them.
  void clear();

 private:
  static constexpr std::uint32_t vacant = ~std::uint32_t{0};

  /// Fibonacci hashing of the three coordinates; its high bits are the good ones.
  static std::uint64_t hash(Point3 p) {
    const std::uint64_t xy = (std::uint64_t{static_cast<std::uint32_t>(p.x)} << 32) | static_cast<std::uint32_t>(p.y);
    const std::uint64_t mixed = xy * 0x9E3779B97F4A7C15u ^ static_cast<std::uint32_t>(p.z) * 0xC2B2AE3D27D4EB4Fu;
    return (mixed ^ (mixed >> 32)) * 0x9E3779B97F4A7C15u;
  }

  std::uint32_t insert(Point3 p, std::size_t slot);
  void resize(unsigned bits);

  std::vector<Point3> vertices_;
  std::vector<std::uint32_t> slots_;
  std::size_t mask_ = 0;
  unsigned shift_ = 0;
};

/// Drops triangles that have a corner twice. Returns how many.
std::size_t drop_degenerate(Mesh& mesh);

/// Drops vertices that are no triangle's corner; the others keep their order.
void drop_unused_vertices(Mesh& mesh);

}  // namespace weft::mesh
