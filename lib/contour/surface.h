// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/mesh.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace weft::contour {

/// How high the surface of a model is at a place, wherever air lies over it.
class Surface {
 public:
  /// Copies what it needs of the meshes. Cost: O(triangles), 60 bytes each.
  explicit Surface(std::span<const Mesh* const> meshes);

  struct Height {
    double z_um = 0;
    double slope = 0;  ///< tangent of its angle against the horizontal
  };
  /// The surface between two heights that air lies over; nothing: none is there.
  /// Cost: the triangles over a cell of the grid that the place lies in, about ten.
  std::optional<Height> between(Point at, double low_um, double high_um) const;

 private:
  struct Facet {
    Point a, b, c;                // counter-clockwise from above
    double z0, along_x, along_y;  // its plane: z0 + along_x·x + along_y·y
    Um bottom, top;
    bool up;  // solid lies below it
  };
  std::size_t cell_of(Um x, Um y) const;
  std::span<const std::uint32_t> facets_over(Point at) const;

  std::vector<Facet> facets_;
  Box box_;
  Um cell_ = 1000;
  std::size_t columns_ = 0, rows_ = 0;
  std::vector<std::uint32_t> starts_, in_cell_;  // of each cell in in_cell_, and one more
};

}  // namespace weft::contour
