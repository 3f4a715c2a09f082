// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/pattern.h"

#include <array>
#include <cstdint>
#include <vector>

namespace weft::infill {

/// A point that has a cell: all places p with |p − site|² − weight least for it. Units of cells.
struct Site {
  double x = 0, y = 0, weight = 0;
};

/// A corner of a cell, relative to the tile that its site lies in.
struct Corner {
  Turned at;
};

/// The cell of a site among sites that repeat every `tile` along both axes: a convex polygon, counter-clockwise; empty
/// for a site that is nearest to nothing.
/// Source: Aurenhammer 1987, "Power diagrams"; half-planes cut one after the other. Cost: O(sites within 3 cells).
std::vector<Corner> cell_of(const std::vector<Site>& sites, std::size_t site, int tile);

/// The borders between the cells of a tile, and how lines run along them.
class CellWalls {
 public:
  /// Cost: O(n²) in the sites.
  CellWalls(std::vector<Site> sites, int tile);

  /// @param cell  what a unit is, µm
  Drawing drawn(const PatternPlace& p, double cell) const;

 private:
  struct Wall {
    std::uint32_t u = 0, v = 0;  ///< corners
    int wrap_x = 0, wrap_y = 0;  ///< tiles from u's to v's
    double length = 0;
    bool twice = false;
  };
  /// An end of a line along a wall: wall × 4 + side × 2 + which end; side 0 is left of u→v, and the only one of a wall
  /// that is drawn once.
  using LineEnd = std::uint32_t;
  struct Place {
    LineEnd end = 0;
    int x = 0, y = 0;  ///< tile of the corner that it is at
  };

  void find(const std::vector<Site>& sites);
  void draw_some_twice();
  void pair_up();
  void merge_loops();
  std::uint32_t corner_of(LineEnd end) const {
    const Wall& wall = walls_[end / 4];
    return end % 2 == 0 ? wall.u : wall.v;
  }
  double angle_of(LineEnd end) const;
  Place across(Place at) const;
  void add_line(Place from, double band, double cell, Curve& to) const;

  int tile_;
  std::vector<Turned> corners_;
  std::vector<Wall> walls_;
  std::vector<std::vector<LineEnd>> at_corner_;  ///< counter-clockwise
  std::vector<bool> shifted_;                    ///< by corner: second with third, … last with first
  std::vector<LineEnd> partner_;
};

}  // namespace weft::infill
