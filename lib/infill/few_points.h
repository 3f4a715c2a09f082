// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <span>

namespace weft::infill {

/// How far what is printed may stand off a curve that is only to hold something up. With 10 µm a gyroid has a third
/// fewer points, and its corners are so sharp that the nozzle takes a quarter longer for it (80 mm/s, 1500 mm/s², a 0.4
/// nozzle).
inline constexpr Um curve_tolerance = 5;
/// The same of lines of that density: those of a skin lie beside each other.
constexpr Um tolerance_of(double density) {
  return density < 1 ? curve_tolerance : 3;
}

/// A curve with fewer points, which stand off to its outside, so that chords pass it on both sides: half as many more
/// would be needed on the curve itself. No place of either is farther from the other than 1.5 × bound; of an arc, than
/// the bound. Ends of an open line stay, as do corners sharper than 60°.
/// @param closed  the last point is joined with the first, which it is not
/// Source: Imai & Iri 1988, "Polygonal approximations of a curve", greedy. Cost: O(n log (points of a chord)).
Polyline few_points(std::span<const Point> line, bool closed, double bound);

}  // namespace weft::infill
