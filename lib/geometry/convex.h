// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <optional>

namespace weft::geometry {

/// Whether a ring runs once round a convex area, counter-clockwise, so that no two of its edges have a point in common
/// but neighbours their corner. Exact. Cost: O(n).
bool runs_round_convex(const Ring& ring);

/// A convex ring with each edge that much further in: what geometry::offset makes of it, at a hundredth of the cost.
/// Nothing where the ring is not convex and counter-clockwise, has collinear corners, or would lose an edge.
/// Cost: O(n).
std::optional<Ring> inset_of_convex(const Ring& ring, Um by);

}  // namespace weft::geometry
