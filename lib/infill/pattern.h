// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/scan.h"
#include "settings/groups/infill.h"

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

/// What sparse infill is drawn of. A pattern draws over a box and knows no walls: what is outside of the area is cut
/// off, what is left is joined along the walls, and the width of the lines makes up for what is missing or too much.
namespace weft::infill {

/// A piece of the plane, fractional microns.
struct Span2 {
  Turned min, max;
};

/// What a pattern is drawn for. Lengths in µm, in the pattern's frame: turned by the angle of the infill about the
/// point where the pattern is anchored.
struct PatternPlace {
  double band = 0;        ///< of a line
  double density = 0;     ///< 0 < density < 1, of the whole pattern
  double z = 0;           ///< top of the layer
  std::size_t index = 0;  ///< of the layer
  Span2 area;             ///< to be covered
  double reach = 0;       ///< no layer of the object is farther than this from the anchor, along either axis

  /// Distance of lines that have the density by themselves.
  double spacing() const { return band / density; }
};

/// Parallel lines over all of the plane.
struct Family {
  double angle_rad = 0;  ///< against the frame
  double pitch = 0;
  double phase = 0;  ///< of one of them, across
};

/// A curve; one that is not closed may end where it likes.
struct Curve {
  std::vector<Turned> points;
  bool closed = false;
};

/// What a pattern is at a height. Its lines have about the density at their band; they are made so exactly afterwards.
struct Drawing {
  std::vector<Family> families{};
  std::vector<Curve> curves{};
  double pitch = 0;   ///< distance of neighbours, which joints along a wall go by
  double longer = 0;  ///< length of the lines at this height over what the density needs; 0: it is measured
};

/// One row a pattern.
struct PatternRow {
  InfillPattern pattern;
  std::string_view meaning;
  std::string_view source;  ///< author, year, title; or whose name it is
  std::string_view formula;
  Drawing (*draw)(const PatternPlace&);  ///< null: it follows the area's edge (sparse.cpp)
  double turn_deg = 0;                   ///< by which each layer is turned against the one below
  double longest_joint = 3;              ///< along the wall, in pitches
};
const PatternRow& row_of(InfillPattern pattern);

// patterns/families.cpp
Drawing draw_lines(const PatternPlace&);
Drawing draw_grid(const PatternPlace&);
Drawing draw_triangles(const PatternPlace&);
Drawing draw_slanted(const PatternPlace&);
Drawing draw_crosszag(const PatternPlace&);
Drawing draw_trihexagon(const PatternPlace&);
Drawing draw_cubic(const PatternPlace&);
Drawing draw_tetrahedral(const PatternPlace&);
Drawing draw_quarter_cubic(const PatternPlace&);
Drawing draw_lateral_lattice(const PatternPlace&);
Drawing draw_lateral_honeycomb(const PatternPlace&);
// patterns/waves.cpp
Drawing draw_honeycomb(const PatternPlace&);
Drawing draw_octagon(const PatternPlace&);
Drawing draw_honeycomb_3d(const PatternPlace&);
Drawing draw_crosshatch(const PatternPlace&);
// patterns/tpms.cpp
Drawing draw_gyroid(const PatternPlace&);
Drawing draw_diamond(const PatternPlace&);
Drawing draw_fischer_koch(const PatternPlace&);
Drawing draw_schwarz_p(const PatternPlace&);
// patterns/space_filling.cpp
Drawing draw_hilbert(const PatternPlace&);
Drawing draw_peano(const PatternPlace&);
// patterns/spirals.cpp
Drawing draw_archimedean(const PatternPlace&);
Drawing draw_octagram(const PatternPlace&);
// patterns/cross.cpp
Drawing draw_cross(const PatternPlace&);
Drawing draw_cross_3d(const PatternPlace&);
// patterns/voronoi.cpp
Drawing draw_voronoi(const PatternPlace&);
Drawing draw_voronoi_3d(const PatternPlace&);

}  // namespace weft::infill
