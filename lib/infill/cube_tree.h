// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/pattern.h"

#include <cstdint>
#include <unordered_set>
#include <vector>

namespace weft::infill {

/// Cubes that stand on a corner and are split in eight where the surface is, down to a least edge; neighbours differ by
/// one level at most. Each cube has its three middle planes as walls.
/// Source: Wu, Wang, Zhang, Westermann 2016, "Self-supporting rhombic infill structures for additive manufacturing";
///         Cura's cubic subdivision, PrusaSlicer's adaptive cubic.
class CubeTree {
 public:
  /// @param spacing  of lines at the least edge, as a whole: band / density
  /// @param radius   everything lies within it around the origin, µm
  CubeTree(double spacing, double radius);

  /// The surface is here, µm from the origin.
  void add(double x, double y, double z);
  /// After the last `add`.
  void balance();

  /// The walls at that height.
  /// Pre: balanced. Cost: O(cubes that the height meets).
  std::vector<Curve> cut(double z) const;

  double least_edge() const { return edge_; }

 private:
  /// A cube's place in the lattice of its level.
  struct Cell {
    int x = 0, y = 0, z = 0;
  };
  static std::uint64_t key(Cell c);
  Cell cell_of(double u, double v, double w, int level) const;
  struct Piece;
  void walk(Cell cell, int level, double z, std::vector<Piece>& pieces) const;

  double edge_;                                           // of the smallest cubes
  int levels_ = 1;                                        // the root's is levels_
  double half_ = 0;                                       // of the root's edge: it is centred
  std::vector<std::unordered_set<std::uint64_t>> split_;  // by level
};

}  // namespace weft::infill
