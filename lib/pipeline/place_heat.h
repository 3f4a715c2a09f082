// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/stages.h"

#include <cstddef>
#include <vector>

/// Nozzles that wait are cooled and heated again at moments of the timed plan.
namespace weft::pipeline {

/// What is known of a layer's times once its steps are packed.
struct LayerTimes {
  bool first = false;                                   ///< on the bed
  std::vector<float> step_s;                            ///< of each step
  std::vector<std::pair<std::size_t, ToolId>> changes;  ///< of the tool: step, and what is loaded
};

/// The times of a layer with that many seconds for each step.
LayerTimes times_of(const LayerPlan& layer, std::vector<float> step_s);

/// What heat_plan (tools/heat.h) wants, before the step in which its moment lies: no later than it says.
/// Time that nozzles and beds take to get warm is not part of the plan.
void place_heat(const std::vector<Settings>& tools, const std::vector<LayerTimes>& layers, PlannedPlate& plate);

/// Puts it among the steps.
void add_heat(const std::vector<std::pair<std::size_t, SetTemperature>>& heat, LayerPlan& layer);

}  // namespace weft::pipeline
