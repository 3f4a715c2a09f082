// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/groups/machine.h"
#include "settings/groups/material.h"

#include <optional>

namespace weft {

/// What a print costs, in MachineSettings::currency.
struct Cost {
  double filament = 0, machine = 0;
  double total() const { return filament + machine; }
};

/// Nothing when neither the filament nor the machine has a price. Heating and custom G-code are not in the time.
inline std::optional<Cost> cost_of(const MachineSettings& machine, const MaterialSettings& material, double filament_g,
                                   double print_time_s) {
  if (material.filament_cost <= 0 && machine.machine_hourly_cost <= 0) return std::nullopt;
  return Cost{filament_g / 1000 * material.filament_cost, print_time_s / 3600 * machine.machine_hourly_cost};
}

}  // namespace weft
