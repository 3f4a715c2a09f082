// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/table.h"
#include "geometry/touching.h"
#include "settings/groups/support.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

/// The distances that support keeps, resolved.
namespace weft::support {
using namespace weft::literals;

/// What lies no further beside support does not sag between.
inline constexpr Um reached = 1.5_mm;

/// How far a round corner of support may be cut: support needs no finer ones.
inline constexpr Um coarse_arc = 40_um;

inline Um top_gap(const SupportSettings& s) {
  return s.support_top_distance.value_or(s.support_z_distance);
}
inline Um bottom_gap(const SupportSettings& s) {
  return s.support_bottom_distance.value_or(s.support_z_distance);
}
inline Um line_width(const SupportSettings& s, Um nozzle) {
  return length_or(s.support_line_width, nozzle, nozzle);
}

/// Diameters of branches, where the settings leave them to the style.
struct BranchStyle {
  SupportTreeStyle style;
  Um tip, branch;
  double angle;  ///< how fast they get thicker, °
};
inline constexpr std::array branch_styles{
    BranchStyle{SupportTreeStyle::organic, 0.8_mm, 2_mm, 5},
    BranchStyle{SupportTreeStyle::slim, 0.6_mm, 1.2_mm, 3},
    BranchStyle{SupportTreeStyle::strong, 1_mm, 4_mm, 7},
};
static_assert(in_order(branch_styles, &BranchStyle::style), "row i of branch_styles is style i");
inline BranchStyle branch_style(const SupportSettings& s) {
  BranchStyle out = row_of(branch_styles, s.support_tree_style);
  out.tip = s.support_tree_tip_diameter.value_or(out.tip);
  out.branch = std::max(out.tip, s.support_tree_branch_diameter.value_or(out.branch));
  out.angle = s.support_tree_branch_diameter_angle.value_or(out.angle);
  return out;
}

/// How far from the middle of a tip what it holds may reach: support_tree_branch_distance from its edge, or as far as
/// the places between tips are when only support_tree_top_rate of what is held lies on one (hexagons).
inline Um tip_covers(const SupportSettings& s, const BranchStyle& style) {
  const double lattice = style.tip * std::sqrt(std::numbers::pi / (6 * std::sqrt(3.0) * s.support_tree_top_rate / 100));
  return std::max(style.tip / 2 + s.support_tree_branch_distance, rounded(lattice));
}

/// The free length that strands of a roof cross from branch to branch. Strands of ten nozzles' length sag by less than
/// their height, and there are more layers above them.
inline Um roof_span(Um nozzle) {
  return 10 * nozzle;
}

/// What stands on the part does so by pieces of beads of that length: shorter ones do not stay where they are laid.
inline Um foot_length(Um line) {
  return 3 * line;
}

/// How far feet are from each other at most: further than strands of a roof cross, as nothing lies on what sags there.
inline Um between_feet(Um nozzle) {
  return 25 * nozzle / 2;
}

/// Columns whose middle is no further from their edge are hollow: between lines as far apart as that density asks for
/// they would have none, or one that stands alone.
inline Um hollow_column(Um line, double share) {
  return rounded(0.6 * (share > 0 ? line / share : line * 10.0));
}

/// Roofs narrower than that are beads along them.
inline constexpr Um narrow_roof = 3_mm;

/// The free length that these cross: they have no other level above them, only the part.
inline Um narrow_roof_span(Um nozzle) {
  return 6 * nozzle;
}

/// The share of plastic of the strands that a roof on columns lies on: two beads' width between one and the next, which
/// the thinnest cap crosses.
inline double under_roof_share(const SupportSettings& s) {
  return std::min(s.support_interface_density, std::max(100.0 / 3, s.support_infill_rate)) / 100;
}

/// What is narrower is held by tips themselves: it lies on no more than one.
inline Um narrowest_roof(const BranchStyle& style) {
  return style.tip * 3 / 2;
}

/// How far from the next branch a place under such a roof may lie. No two neighbours are then further from each other
/// than twice that, and those of a lattice of triangles 1.6 times.
inline Um roof_covers(const BranchStyle& style, Um nozzle) {
  return (style.tip + roof_span(nozzle)) * 10 / 17;
}

inline Regions grown(const Regions& regions, Um by, Um arc_tolerance = coarse_arc) {
  if (regions.empty() || by == 0) return regions;
  return geometry::offset_apart(regions, {.by = by, .corner = geometry::Corner::round, .arc_tolerance = arc_tolerance});
}

/// As geometry::opening, with arcs of as many corners as support needs; and so much wider.
inline Regions opened(const Regions& regions, Um radius, Um wider = 0) {
  return grown(grown(regions, -radius), radius + wider);
}
/// As geometry::closing, with such arcs.
inline Regions closed(const Regions& regions, Um radius) {
  return grown(grown(regions, radius), -radius);
}

/// Beads of support follow its outlines no closer than that; so much more is kept off the part.
inline constexpr Um outline_bound = 30_um;

/// Outlines of support need no finer corners than that.
inline constexpr Um coarse_outline = 25_um;

inline void append(Regions& to, const Regions& more) {
  to.insert(to.end(), more.begin(), more.end());
}

}  // namespace weft::support
