// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/scan.h"

namespace weft::infill {

/// Whole lines between the levels of most edges that lines run along, one below and one above, and as many beyond them
/// as there is room for: a corner that stands out of a strip does not make its lines too narrow. Where only one of them
/// is not loose, lines of that band begin there.
/// @param band of a line, in the outline's unit
/// Pre: the outline has a point. Cost: O(n log n).
LineSet fitted_lines(const Outline& outline, double band);

}  // namespace weft::infill
