// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

/// Many things of one kind side by side in a repeating pattern: one of them, or two that are turned against each other,
/// at the points of a lattice.
namespace weft::plate {

/// Things at whole multiples of `u` and `v`.
struct Lattice {
  struct Thing {
    Point at;
    std::size_t turn = 0;
  };
  std::vector<Thing> motif;  ///< what stands at each point
  Point u, v;
  double mm2 = 0;  ///< of the bed, for each thing
};

/// Where a thing in turn `b` may not be, so as not to meet one in turn `a` that stands at (0, 0).
using NoFit = std::function<const Regions&(std::size_t a, std::size_t b)>;

/// The densest lattices that are found, the densest first: of rows along X and along Y, of single things and of pairs
/// that touch at a corner of their no-fit polygon. Deterministic. Law: no two things of a lattice meet.
/// Source: Kuperberg and Kuperberg, "Double-lattice packings of convex bodies in the plane".
/// @param turns how many ways there are to lie  @param most lattices wanted
/// Cost: some Booleans for each pair that is tried, no more than a thousand.
std::vector<Lattice> lattices(std::size_t turns, const NoFit& no_fit, std::size_t most);

}  // namespace weft::plate
