// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/pipeline.h"

#include <string>
#include <utility>
#include <vector>

namespace weft::test {

/// On a bed of 200 mm, or as large as is said, whose start G-code only homes.
inline Job plain_job(std::vector<std::string> models = {}, Um size = 200'000) {
  Job job;
  job.models = std::move(models);
  auto& s = job.settings;
  s.machine.machine_width = s.machine.machine_depth = s.machine.machine_height = size;
  s.machine.home_position = Ring{{0, 0}};
  s.gcode.machine_start_gcode = "G28";
  return job;
}

}  // namespace weft::test
