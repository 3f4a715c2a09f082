// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "motion/motion.h"

#include <cstddef>

namespace weft::motion {

inline const Rules& of_scope(AllRules rules, ScopeId scope) {
  return rules[scope < rules.size() ? scope : 0];
}

/// Those of the tool in use, for its filament and how that is drawn back; of the layer where there is one tool.
inline const Rules& of_tool(const AllRules& all, ToolId tool, const Rules& layer) {
  return tool < all.tools.size() ? all.tools[tool] : layer;
}

/// Speed of a feature before its beads' widths are looked at, mm/s.
double feature_speed_mm_s(const Rules& rules, Role role);

/// Acceleration of a feature, mm/s², within what the machine bears.
double feature_acceleration_mm_s2(const Rules& rules, Role role);
/// The same of a bead: walls that hang may have their own.
double bead_acceleration_mm_s2(const Rules& rules, const Extrude& bead);
double travel_acceleration_mm_s2(const Rules& rules);

/// Sets the speed of a bead, one a segment where its width asks for it: mm³/s stay below material_max_volumetric_speed
/// at every junction. Neighbouring segments whose
/// speeds differ by less than 5 % share the lower one. Pre: the path has been cut.
void set_bead_speed(const Rules& rules, Extrude& bead);

/// Speeds, accelerations and moves for every step; a Travel is put in where a bead begins away from the nozzle.
void set_speeds(AllRules rules, LayerPlan& layer, std::optional<Point3> start);

}  // namespace weft::motion
