// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/nozzles.h"

#include "settings/tools.h"
#include "support/stack.h"

#include <algorithm>

namespace weft::pipeline {

Um nozzle_of(const Settings& plate, std::optional<int> tool) {
  const Um usual = plate.machine.nozzle_diameter;
  if (!tool || tool_count(plate) < 2) return usual;
  return settings_of_tools(plate).at(static_cast<std::size_t>(*tool)).machine.nozzle_diameter;
}

Settings of_support(const Settings& plate, Settings own) {
  auto& s = own.support;
  const auto nozzle = [&](const std::optional<int>& tool) {
    return tool ? nozzle_of(plate, tool) : own.machine.nozzle_diameter;
  };
  const Um columns = nozzle(s.support_infill_extruder_nr);
  const bool dense = s.support_roof_enable || s.support_bottom_enable;
  const Um interfaces = dense ? nozzle(s.support_interface_extruder_nr) : columns;
  const auto [narrow, wide] = std::minmax(columns, interfaces);
  if (narrow < wide) s.support_infill_sparse_thickness = support::most_height(s, narrow);
  own.machine.nozzle_diameter = wide;
  return own;
}

}  // namespace weft::pipeline
