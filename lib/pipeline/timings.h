// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/stage_table.h"

#include <array>

namespace weft {

/// Wall-clock time of each stage, ms. The audit reads layers while others are written: its time counts in gcode, too.
struct Timings {
  std::array<double, pipeline::stage_count> of{};  ///< by Stage
  double total = 0;
  double& operator[](pipeline::Stage stage) { return of[static_cast<std::size_t>(stage)]; }
  double operator[](pipeline::Stage stage) const { return of[static_cast<std::size_t>(stage)]; }
};

}  // namespace weft
