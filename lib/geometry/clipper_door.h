// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"
#include "geometry/boolean.h"

#include <cstdint>
#include <span>
#include <vector>

/// The only door to Clipper; private to geometry/. Works on a grid of `steps` to the micron around an origin of the
/// caller's choice, so that intersection points are rounded to whole microns once, and a moved input gives a moved
/// output.
namespace weft::geometry::clipper {

inline constexpr int steps = 16;

/// A point in 1/steps µm relative to the origin.
struct FinePoint {
  std::int64_t x = 0, y = 0;
};
using FineRing = std::vector<FinePoint>;
using FineRings = std::vector<FineRing>;

enum class Operation { unite, intersect, subtract, exclusive_or };

/// Post: regions as core/polygon.h says, no collinear vertices, none below tolerances::sliver_area_um2.
Regions run(Operation operation, WindingRule rule, const FineRings& subject, const FineRings& clip, Point origin);

/// The same for several operations on one input, in their order: it is read once.
std::vector<Regions> run(std::span<const Operation> operations, WindingRule rule, const FineRings& subject,
                         const FineRings& clip, Point origin);

/// On the lattice of whole microns, without collinear points; empty where that leaves no area.
Ring coarse(const FineRing& ring, Point origin);

/// The regions of an operation's result. Pre: rings (outers counter-clockwise, holes clockwise) cross at the most where
/// corners were rounded to whole microns. Post: as that of `run`, which this is a part of.
Regions tidied(std::vector<Ring> rings, Point origin);

}  // namespace weft::geometry::clipper
