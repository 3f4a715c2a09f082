// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <span>

/// Booleans on regions. Inputs may overlap, touch and be wound as they like where it is not said otherwise.
/// Post (all): regions do not overlap; orientation as Region says; no collinear vertices; parts and holes below
///             tolerances::sliver_area_um2 are dropped; crossings of the input are rounded to whole microns; rings may
///             touch, no two edges cross properly (but where crossings are as dense as the lattice itself).
/// Law:        moving the input by whole microns moves the output and changes nothing else.
/// Cost:       O((n + k) log n), k crossings; about 0.5 µs a vertex.
/// Source:     Vatti's sweep as in Clipper 6.4.
namespace weft::geometry {

/// Which winding numbers are solid.
enum class WindingRule { nonzero, positive, even_odd };

/// Union under the rule: the regions that closed rings of any shape enclose.
/// @param met set where rings met or crossed, so that what they enclose had to be found by the sweep
Regions regions_from_rings(std::span<const Ring> rings, WindingRule rule = WindingRule::nonzero, bool* met = nullptr);

Regions unite(const Regions& regions);
Regions unite(const Regions& a, const Regions& b);
/// This and the two below: asks between batches of thousands of regions whether the job is to be stopped (core/stop.h).
Regions intersect(const Regions& a, const Regions& b);
/// What of `from` is not in `what`.
Regions subtract(const Regions& from, const Regions& what);
/// Both sides of a cut, at less than the cost of both: the regions of intersect(what, by) and of subtract(what, by),
/// which may come in another order where corners are equally low.
struct Cut {
  Regions inside, outside;
};
Cut cut(const Regions& what, const Regions& by);
Regions exclusive_or(const Regions& a, const Regions& b);

/// All rings of the regions, outers before their holes.
std::vector<Ring> rings_of(const Regions& regions);

}  // namespace weft::geometry
