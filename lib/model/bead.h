// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "core/scope_id.h"
#include "model/role.h"
#include "model/tool.h"

#include <cstdint>
#include <vector>

namespace weft {

/// One vertex of a bead's centreline.
struct Junction {
  Point at;
  Um width = 0;  ///< band: volume = width × layer height × length × flow (model/flow.h)
  float flow =
      1.F;  ///< share of the band's volume that is really extruded; width and flow vary linearly between junctions
  friend bool operator==(const Junction&, const Junction&) = default;
};

/// A line of plastic: a centreline whose width and flow vary along it.
struct Bead {
  std::vector<Junction> path;  ///< at least two; a closed bead does not repeat its first junction
  Role role = Role::outer_wall;
  bool closed = false;
  std::uint16_t inset = 0;  ///< walls: 0 is the outermost, counted inwards
  std::uint32_t part = 0;   ///< index of the region of the layer it belongs to: beads of a part are printed together
  std::uint32_t sequence =
      0;  ///< skin: those of equal non-zero value are printed in their order; support: not 0, after all others
  ToolId tool = any_tool;   ///< what it is printed with
  ScopeId scope = 0;        ///< what settings it is printed with
  bool on_support = false;  ///< skin that rests on support
  friend bool operator==(const Bead&, const Bead&) = default;
};
using Beads = std::vector<Bead>;

/// Mean cross-section between two junctions of a bead of that height, mm²: the integral of the product of two linear
/// functions, so that cutting a segment changes no volume.
inline double mean_area_mm2(const Junction& a, const Junction& b, double height_mm) {
  const double wa = a.width, wb = b.width, fa = static_cast<double>(a.flow), fb = static_cast<double>(b.flow);
  return (2 * wa * fa + wa * fb + wb * fa + 2 * wb * fb) / 6000.0 * height_mm;
}

/// Around the centreline.
Box box_of(const Bead& bead);

/// Length of the centreline, mm; a closed bead's closing segment counts.
double length_mm(const Bead& bead);

/// Extruded volume, mm³, at that layer height: ∫ width · flow ds · height.
double volume_mm3(const Bead& bead, Um height);

}  // namespace weft
