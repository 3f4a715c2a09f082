// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/simplify.h"

namespace weft {

/// Leaves out what a path's width does not hold for `least` µm: a height is cut, and a dip filled, to where it is so
/// long (half as long at an end of the path, as if it went on behind it); a path that is shorter is as wide as on
/// average. What is held stays as it is, steps included. Vertices are added where the width
/// changes. A closed path does not repeat its first vertex. Cost: O(n).
/// Source: Vincent 1993, "Grayscale area openings and closings" (along a line); Rohwer 2005, "Nonlinear smoothing and
/// multiresolution analysis" (the mean of both orders, so that jitter keeps its mean).
void steady_widths(VertexPath& path, bool closed, double least);

}  // namespace weft
