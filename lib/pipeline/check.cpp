// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/check.h"

#include "infill/infill.h"
#include "travel/travel.h"
#include "walls/walls.h"

#include <iterator>

namespace weft::pipeline {

Notices check(const Settings& settings) {
  Notices out = walls::check(settings.walls, settings.machine.nozzle_diameter, settings.layers.layer_height);
  auto of_infill = infill::check(settings.infill, settings.machine.nozzle_diameter, settings.layers.layer_height);
  std::move(of_infill.begin(), of_infill.end(), std::back_inserter(out));
  auto of_travel = travel::check(settings.travel, settings.retraction);
  std::move(of_travel.begin(), of_travel.end(), std::back_inserter(out));
  return out;
}

}  // namespace weft::pipeline
