// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "model/bead.h"

#include <array>
#include <cstdint>
#include <vector>

namespace weft {

/// What a print, or a part of it, takes. Sums add up in layer order, so that they do not depend on threads.
struct Statistics {
  struct Feature {
    double mm = 0, mm3 = 0, s = 0;  ///< length and volume of the beads (before material_flow), time
  };
  std::array<Feature, roles.size()> features{};  ///< by Role

  struct Walls {
    std::int64_t beads = 0;
    double variable_width_mm = 0;    ///< length along which a wall's width changes
    double flow_compensated_mm = 0;  ///< length printed with a flow ratio below 1
    double min_flow_ratio = 1;
    Um min_width = max_coord;             ///< least line width of a wall; max_coord when there is none
    std::array<double, 4> over_air_mm{};  ///< length with up to a quarter, a half … of the width over air
    double whole_over_air_mm = 0;         ///< of the last of them: with all of it
  } walls;

  struct Arcs {
    std::int64_t count = 0, pieces = 0;  ///< and the pieces of paths that they stand for
    double worst_um = 0;                 ///< how far one of these is from its arc
  } arcs;

  struct Travels {
    double mm = 0, s = 0;
    std::int64_t moves = 0;  ///< Travel steps
    std::int64_t retractions = 0;
    std::int64_t wall_crossings = 0;
    double retraction_s = 0;  ///< retracting, priming and wiping
  } travel;

  /// Of one tool.
  struct Tool {
    double filament_mm = 0, filament_mm3 = 0, filament_g = 0;
    double s = 0;              ///< while it is loaded
    double tower_mm3 = 0;      ///< of that volume, what went into the tower
    std::int64_t changes = 0;  ///< to it
  };
  std::vector<Tool> tools;  ///< by ToolId; empty where the plan names none

  double filament_mm = 0, filament_mm3 = 0, filament_g = 0;  ///< with material_flow and extra prime
  std::vector<double> layer_s;                               ///< one a layer
  std::vector<double> silent_layer_s;                        ///< the same in silent mode; empty: there is none
  double print_time_s = 0;                                   ///< sum of layer_s: without heating and custom G-code

  /// Of that tool, which then is one of `tools`.
  Tool& tool(ToolId id);

  /// Adds the layers that come after these.
  void append(const Statistics& later);
};

}  // namespace weft
