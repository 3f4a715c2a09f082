// SPDX-License-Identifier: GPL-3.0-or-later
#include "infill/pattern.h"

#include "core/table.h"

#include <array>

namespace weft::infill {
namespace {

// b is the band of a line, ρ the density.
constexpr std::array pattern_rows{
    PatternRow{InfillPattern::lines, "parallel lines, turned by 90° a layer", "", "pitch b/ρ", draw_lines, 90},
    PatternRow{InfillPattern::grid, "lines in two directions", "", "pitch 2b/ρ", draw_grid, 0},
    PatternRow{InfillPattern::triangles, "lines in three directions through common points", "",
               "pitch 3b/ρ; 0°, 60°, 120°", draw_triangles, 0},
    PatternRow{InfillPattern::gyroid, "waves that turn with the height",
               "Schoen 1970, Infinite periodic minimal surfaces without self-intersections",
               "sin x cos y + sin y cos z + sin z cos x = 0", draw_gyroid, 0},
    PatternRow{InfillPattern::concentric, "rings along the walls", "", "distance b/ρ", nullptr, 0},
    PatternRow{InfillPattern::zigzag, "lines, joined however long the way along the wall is", "Cura", "pitch b/ρ",
               draw_lines, 90, 1e6},
    PatternRow{InfillPattern::aligned, "lines in one direction in all layers", "PrusaSlicer: alignedrectilinear",
               "pitch b/ρ", draw_lines, 0},
    PatternRow{InfillPattern::slanted, "lines, every second one slanted from one neighbour to the other",
               "PrusaSlicer: line", "pitch b/ρ, slant ±(b/ρ − b)", draw_slanted, 90},
    PatternRow{InfillPattern::crosszag, "lines, moved aside from layer to layer", "OrcaSlicer",
               "pitch b/ρ, 0.4 mm a layer", draw_crosszag, 0},
    PatternRow{InfillPattern::trihexagon, "lines in three directions: stars and hexagons", "Cura",
               "pitch 3b/ρ; one direction is half a pitch aside", draw_trihexagon, 0},
    PatternRow{InfillPattern::cubic, "cubes that stand on a corner", "Cura", "pitch 3b/ρ; 0°, 120°, 240° at z/√2",
               draw_cubic, 0},
    PatternRow{InfillPattern::tetrahedral, "tetrahedra and octahedra", "Cura", "pitch 4b/ρ; 0° and 90°, each at ±z/√2",
               draw_tetrahedral, 0},
    PatternRow{InfillPattern::quarter_cubic, "tetrahedra and truncated tetrahedra", "Cura",
               "as tetrahedral, 90° a quarter of the pitch further", draw_quarter_cubic, 0},
    PatternRow{InfillPattern::cubicsubdiv, "cubes, smaller near the surface", "Cura",
               "edges 2ᵏ·2√6 b/ρ, split where the surface is", draw_cubic, 0},
    PatternRow{InfillPattern::support_cubic, "cubes, smaller below tops", "PrusaSlicer: supportcubic", "as cubicsubdiv",
               draw_cubic, 0},
    PatternRow{InfillPattern::honeycomb, "hexagons, turned by 60° a layer", "PrusaSlicer",
               "side b(1 + √(1 − ¾ρ)) / 1.299ρ", draw_honeycomb, 60},
    PatternRow{InfillPattern::octagon, "octagons", "Cura", "side 0.686 b/ρ", draw_octagon, 0},
    PatternRow{InfillPattern::honeycomb_3d, "truncated octahedra",
               "Kelvin 1887, On the division of space with minimum partitional area; PrusaSlicer: 3dhoneycomb",
               "waves 1.104 b/ρ apart, swing a triangle wave of the height", draw_honeycomb_3d, 0},
    PatternRow{InfillPattern::crosshatch, "straight walls that change their direction with the height", "OrcaSlicer",
               "waves 1.052 b/ρ apart", draw_crosshatch, 0},
    PatternRow{InfillPattern::lateral_lattice, "walls that lean by 45° both ways, one direction of lines", "OrcaSlicer",
               "pitch 2b/ρ at ±z", draw_lateral_lattice, 0},
    PatternRow{InfillPattern::lateral_honeycomb, "hexagons seen along the lines", "OrcaSlicer", "pitch 4/3 b/ρ",
               draw_lateral_honeycomb, 0},
    PatternRow{InfillPattern::diamond, "the diamond surface", "Schwarz 1890, Gesammelte mathematische Abhandlungen",
               "cos(x + y) cos(z − π/4) + cos(x − y) cos(z + π/4) = 0", draw_diamond, 0},
    PatternRow{InfillPattern::fischer_koch, "the surface S", "Fischer & Koch 1987, On 3-periodic minimal surfaces",
               "cos 2x sin y cos z + cos 2y sin z cos x + cos 2z sin x cos y = 0", draw_fischer_koch, 0},
    PatternRow{InfillPattern::schwarz_p, "the primitive surface", "Schwarz 1890, Gesammelte mathematische Abhandlungen",
               "cos x + cos y + cos z = 0", draw_schwarz_p, 0},
    PatternRow{InfillPattern::hilbert, "a curve through all cells of a square",
               "Hilbert 1891, Über die stetige Abbildung einer Linie auf ein Flächenstück", "cells b/ρ", draw_hilbert,
               0},
    PatternRow{InfillPattern::peano, "a curve through all cells of a square",
               "Peano 1890, Sur une courbe, qui remplit toute une aire plane", "cells b/ρ", draw_peano, 0},
    PatternRow{InfillPattern::archimedean, "a spiral", "Archimedes, On spirals", "r = bθ / 2πρ", draw_archimedean, 0},
    PatternRow{InfillPattern::octagram, "a spiral of stars", "PrusaSlicer: octagramspiral", "r grows by √2 b/ρ a turn",
               draw_octagram, 0},
    PatternRow{InfillPattern::fermat, "rings along the walls, joined to one double spiral",
               "Zhao et al. 2016, Connected Fermat spirals for layered fabrication", "distance b/ρ", nullptr, 0},
    PatternRow{InfillPattern::voronoi, "cells around scattered points",
               "Voronoï 1908, Nouvelles applications des paramètres continus à la théorie des formes quadratiques",
               "a point for (2.5 b/ρ)²", draw_voronoi, 0},
    PatternRow{InfillPattern::voronoi_3d, "cells around points in space",
               "Martínez et al. 2016, Procedural Voronoi foams for additive manufacturing", "a point for 1.5 (3 b/ρ)³",
               draw_voronoi_3d, 0},
    PatternRow{InfillPattern::cross, "a closed curve through triangles",
               "Sierpiński 1912, Sur une nouvelle courbe continue qui remplit toute une aire plane; Cura",
               "legs 1.138 b/ρ", draw_cross, 0},
    PatternRow{InfillPattern::cross_3d, "the same with walls that lean", "Kuipers et al. 2019, CrossFill; Cura",
               "legs 1.138 b/ρ", draw_cross_3d, 0},
    PatternRow{InfillPattern::lightning, "branches below what is solid",
               "Tricard et al. 2020, Ribbed support vaults for 3D printing of hollowed objects; Cura",
               "branches b/ρ apart", draw_grid, 0},
    PatternRow{InfillPattern::lockedzag, "zigzag whose density follows the distance from the surface", "OrcaSlicer",
               "pitch b/ρ", draw_lines, 90, 1e6},
    PatternRow{InfillPattern::medial, "lines between walls and medial axis, joined to one",
               "Ding et al. 2016, Adaptive path planning for wire-feed additive manufacturing using medial axis "
               "transformation",
               "u = d_wall / (d_wall + d_axis) at (k + ½) / n", nullptr, 0},
    PatternRow{InfillPattern::streamlines, "evenly spaced lines along a field of directions, every second layer across",
               "Jobard & Lefer 1997, Creating evenly-spaced streamlines of arbitrary density", "distance b/ρ", nullptr,
               0},
};
static_assert(in_order(pattern_rows, &PatternRow::pattern), "row i of pattern_rows is pattern i");
static_assert(pattern_rows.size() == choices_of(InfillPattern{}).size(), "a pattern has no row");

}  // namespace

const PatternRow& row_of(InfillPattern pattern) {
  return weft::row_of(pattern_rows, pattern);
}

}  // namespace weft::infill
