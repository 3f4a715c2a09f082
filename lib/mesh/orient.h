// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/adjacency.h"
#include "mesh/repair.h"

namespace weft::mesh {

/// Turns triangles of `mesh` so that each shell has one orientation, and shells so that the outside is outside:
///
/// 1. Within a shell (triangles connected through edges of exactly two) the majority of the triangles is right.
/// 2. A closed shell in which more than a quarter had to be turned says nothing about itself: it is turned outward.
/// 3. If the shells together enclose a negative volume, the file is inside out: all are turned. Scraps of surface, with
/// no
///    fewer open edges than triangles, have no say in it.
/// 4. A closed shell that still faces inward is a void if its box lies in the box of a shell that faces outward, and a
///    hole if it cuts through one: both stay. Elsewhere it can only be a part that is inside out, and is turned.
///
/// So what the file says is empty is never made solid. An inside-out part within the box of another stays too; slicing
/// sees it as solid nevertheless, unless some shell is a hole that cuts through another (`Mesh::cut_through`).
/// One-sided shells (Möbius) and open ones in rule 4 are left. Writes the counts flipped, inverted_shells, shells and
/// one_sided_shells. Cost: linear, but for rule 4, where shells are looked for in a tree of boxes.
void orient(Mesh& mesh, Adjacency adjacency, Repairs& repairs);

}  // namespace weft::mesh
