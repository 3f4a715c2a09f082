// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <functional>
#include <span>
#include <vector>

/// Private to slice: which part of a region is nearest to which runs of its outline.
namespace weft::slice {

/// @param kind_at of a place on the outline, 0 … count − 1
/// @param borders places on the outline where the kind changes: edges are divided there
/// @param depth what is farther from the outline is nobody's; above 0
/// @return of each kind the regions of what is nearest to outline of that kind; up to rounding they do not overlap.
///         Of an outline that is all of the last kind, which is nobody's, nothing; nor where its medial axis cannot be
///         found.
/// Cost:   that of the axis, and of a union of what was walked along.
/// Source: F. Aurenhammer, "Voronoi diagrams", ACM Computing Surveys 23, 1991: cells of segments.
std::vector<Regions> nearest_to(const Region& region, int count, std::span<const Point> borders, Um depth,
                                const std::function<int(Point)>& kind_at);

}  // namespace weft::slice
