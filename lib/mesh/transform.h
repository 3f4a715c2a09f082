// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/mesh.h"
#include "mesh/read.h"

#include <array>
#include <vector>

namespace weft::mesh {

/// A linear map of space: rows.
using Linear = std::array<std::array<double, 3>, 3>;

inline constexpr Linear identity{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};

/// First b, then a.
Linear product(const Linear& a, const Linear& b);

/// A turn about an axis (0 X, 1 Y, 2 Z), counter-clockwise seen from its tip. Multiples of 90° are exact.
Linear turned_about(int axis, double degrees);

/// Stretched along the axes; a factor below 0 mirrors.
Linear stretched_along(const std::array<double, 3>& factors);

/// The least turn that makes a direction point straight down. Pre: its length is not 0.
Linear laid_on(const std::array<double, 3>& direction);

/// The box of what the map makes of a mesh, mm against `about`: low corner, then high.
std::array<std::array<double, 3>, 2> box_under(const Mesh& mesh, const Linear& map, Point3 about);

/// Each vertex where the map about a point puts it, rounded once. A map that mirrors turns the triangles round, so that
/// the outside stays outside. Pre: the result lies on the lattice. Post: welded, no triangle has a corner twice.
Mesh transformed(Mesh mesh, const Linear& map, Point3 about);

/// What of a mesh lies below a height, and what above it. A vertex at the height belongs to what is above.
struct Halves {
  Mesh lower, upper;
};

/// Cuts a mesh at a height. Post: of a closed mesh both halves are closed: the cut is filled by the even-odd rule;
/// where the mesh is open the cut stays open. Cost: linear, and n log n in the corners of the cut.
Halves cut_at(const Mesh& mesh, Um z);

/// The bodies of a mesh that share no edge, in the order of their first triangles. A shell that faces inward belongs to
/// the smallest body around it, or, where holes cut through shells (Mesh::cut_through), to the first it meets.
std::vector<Mesh> split(const Mesh& mesh);

}  // namespace weft::mesh
