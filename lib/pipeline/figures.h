// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <array>
#include <cstddef>
#include <vector>

namespace weft {

/// What a print asks of nozzle, fan, plastic and eye: asked for with a report.
struct Figures {
  struct Layer {
    double z_mm = 0, s = 0;
    double ratio = 1;            ///< of its time to that of the layer below
    double fan_percent = 0;      ///< mean over its time
    double unsupported_mm2 = 0;  ///< with nothing below
    double longest_span_mm = 0;  ///< laid straight over air
    double least_rest_s = 0;     ///< until the same 2 mm of the layer below are printed on again; 0: none are
  };
  struct Thin {
    std::array<double, 3> at_mm{};
    double mm = 0;  ///< of such wall around there
  };
  std::vector<double> flow_s{};  ///< by mm³/s, rounded down
  double at_limit_percent = 0;   ///< of the time that is printed: at the most that the filament melts
  std::vector<Layer> layers{};
  double thin_mm = 0;               ///< of wall below 0.8 nozzle diameters or 50 % of flow
  std::vector<Thin> thin{};         ///< where most of it is
  double even_outer_percent = 0;    ///< of outer walls: within 5 % of one speed
  double speed_changes_per_m = 0;   ///< F of printed moves
  double mean_cusp_um = 0;          ///< of what is neither upright nor horizontal
  std::size_t faces = 0;            ///< horizontal ones
  double faces_missed_um = 0;       ///< by which they lie off the end of a layer, on average
  double longest_ironing_s = 0;     ///< in a layer
  double least_ironing_mm3_s = 0;   ///< 0: nothing is ironed
  double accelerating_percent = 0;  ///< of the time that the nozzle moves
};

}  // namespace weft
