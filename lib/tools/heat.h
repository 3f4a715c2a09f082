// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/tool.h"
#include "settings/settings.h"

#include <optional>
#include <span>
#include <vector>

/// When nozzles that wait are cooled, and heated again in time.
namespace weft::tools {

/// A change of the tool in the timed plan, in the order of the print; the first loads the first tool.
struct Change {
  double s = 0;              ///< when it begins
  ToolId to = 0;             ///< what it loads
  bool first_layer = false;  ///< of the print, or of an object of those printed one after the other
};

/// At that time a nozzle is told to reach a temperature, and not waited for.
struct Heating {
  double s = 0;
  ToolId tool = 0;  ///< by which the nozzle is named
  int celsius = 0;  ///< 0: off
  friend bool operator==(const Heating&, const Heating&) = default;
};

struct HeatPlan {
  std::vector<Heating> heatings;      ///< by time
  std::vector<ToolId> cold_at_start;  ///< nozzles that are heated later
};

/// A nozzle that no tool is loaded in for longer than machine_min_cool_heat_time_window waits at
/// material_standby_temperature, and is heated so long before its tool is loaded again as
/// machine_nozzle_heat_up_speed takes for the difference. Before its first use it is cold, after its last it is turned
/// off. One that has less time than heating takes stays hot.
/// @param tools settings of each
/// Post: a nozzle that is loaded is told nothing here.
HeatPlan heat_plan(const std::vector<Settings>& tools, std::span<const Change> changes);

}  // namespace weft::tools
