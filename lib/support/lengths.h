// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "geometry/offset.h"
#include "settings/groups/support.h"

/// The distances that support keeps, resolved.
namespace weft::support {
using namespace weft::literals;

/// How far a round corner of support may be cut: support needs no finer ones.
inline constexpr Um coarse_arc = 25_um;

inline Um top_gap(const SupportSettings& s) {
  return s.support_top_distance.value_or(s.support_z_distance);
}
inline Um bottom_gap(const SupportSettings& s) {
  return s.support_bottom_distance.value_or(s.support_z_distance);
}
inline Um line_width(const SupportSettings& s, Um nozzle) {
  return s.support_line_width.value_or(nozzle);
}

inline Regions grown(const Regions& regions, Um by) {
  if (regions.empty() || by == 0) return regions;
  return geometry::offset(regions, {.by = by, .corner = geometry::Corner::round, .arc_tolerance = coarse_arc});
}

inline void append(Regions& to, const Regions& more) {
  to.insert(to.end(), more.begin(), more.end());
}

}  // namespace weft::support
