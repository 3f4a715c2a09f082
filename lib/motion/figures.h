// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "motion/motion.h"

#include <cstdint>
#include <map>
#include <vector>

/// What a plan asks of nozzle, fan and plastic, beyond what it takes.
namespace weft::motion {

/// When a cell of the plate was first and last printed on, in seconds of its layer.
struct CellTime {
  static constexpr Um size = 2000;
  std::uint64_t cell = 0;
  float first_s = 0, last_s = 0;
};

/// Walls that are narrow or short of plastic, around a place.
struct ThinPlace {
  Point at;
  double mm = 0;
};

struct LayerFigures {
  std::vector<double> flow_s{};             ///< by mm³/s, rounded down
  double at_limit_s = 0;                    ///< at 99 % of material_max_volumetric_speed or more
  double moving_s = 0, accelerating_s = 0;  ///< the second is of the first
  double fan = 0;                           ///< 0 … 1, mean over the time
  double printed_mm = 0;
  std::size_t speed_changes = 0;          ///< F between moves that print
  std::map<int, double> outer_wall_mm{};  ///< by speed: e^(bin/100) mm/s
  double thin_mm = 0;                     ///< of wall below 0.8 nozzle diameters or 50 % of flow
  std::vector<ThinPlace> thin{};          ///< by squares of 5 mm
  std::vector<CellTime> cells{};          ///< ascending by cell
};

/// @param layer with speeds, fan and all
/// Cost: another plan of the moves.
LayerFigures figures_of(const AllRules& all, const LayerPlan& layer, std::optional<Point3> start);

}  // namespace weft::motion
