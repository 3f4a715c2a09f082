// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"

#include <cstddef>
#include <functional>

namespace weft::infill {

/// Beads from `from` on get junctions no farther apart than that, each as wide as its gap asks for; all together hold
/// as much plastic as before.
/// @param gap  of a place: distance of its neighbours over the mean one
void follow_gaps(const std::function<double(Point)>& gap, double apart_um, std::size_t from, Beads& beads);

}  // namespace weft::infill
