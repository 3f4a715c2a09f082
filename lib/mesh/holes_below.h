// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "mesh/mesh.h"

namespace weft::mesh {

/// A shell that faces inward and cuts through others is a hole (Mesh::cut_through). What of it reaches below all that
/// faces outward is cut off: the part would stand on a hole, in the air. Anything else comes back as it is.
/// Cost: linear, for meshes with such a shell; nothing for others.
Mesh without_holes_below(Mesh mesh);

}  // namespace weft::mesh
