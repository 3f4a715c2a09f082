// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "travel/travel.h"

#include <vector>

/// The path of a bead on its turn, and cutting it.
namespace weft::travel {

/// In the order it is printed; a closed one ends where it began.
std::vector<Junction> path_of(const Bead& bead, const Turn& turn);

/// The first `length_um` of the path, as the points after its first.
Polyline first_of(const std::vector<Junction>& path, double length_um);

/// Takes the last `length_um` off the path, as the points after its new last.
Polyline cut_end(std::vector<Junction>& path, double length_um);

double length_um(const std::vector<Junction>& path);

}  // namespace weft::travel
