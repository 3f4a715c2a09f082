// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/pattern.h"

#include <vector>

namespace weft::infill {

/// The gyroid sin x cos y + sin y cos z + sin z cos x = 0 at height z, as curves that cross the whole of `area`.
/// @param period  of the surface along each axis, µm
/// Source: Schoen 1970, "Infinite periodic minimal surfaces without self-intersections"; the level set above is its
/// usual
///         approximation. At a fixed z each branch is a graph over x or over y: A sin(y + φ) = −sin z cos x.
std::vector<std::vector<Turned>> gyroid_curves(const Span2& area, double period, double z_um);

/// The period at which lines of that band have the density on average over the height, µm.
double gyroid_period(double band_um, double density);

}  // namespace weft::infill
