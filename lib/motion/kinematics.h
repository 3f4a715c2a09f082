// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "motion/motion.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace weft::motion {

/// One straight move as firmware's planner sees it, or a pause.
struct Move {
  double length_mm = 0;
  double ux = 0, uy = 0, uz = 0;  ///< unit vector
  double speed_mm_s = 0;
  double acceleration_mm_s2 = 0;
  double pause_s = 0;      ///< at rest: length is 0
  std::uint32_t step = 0;  ///< of the layer
  bool prints = false;     ///< may be slowed down to let a layer set
};

/// The moves of a layer with speeds, within what the axes can do.
/// Pre: set_speeds has been applied.
std::vector<Move> moves_of(const AllRules& all, const LayerPlan& layer, std::optional<Point3> start);

/// Printing slowed down: nothing is printed faster than this, slower speeds stay. So what is fastest gives first, and
/// outer walls keep their speed, on which their gloss hangs, as long as anything else has time to give.
struct Slowdown {
  double most_mm_s = std::numeric_limits<double>::infinity();
  double of(double speed_mm_s) const;
  bool slows() const { return most_mm_s != std::numeric_limits<double>::infinity(); }
};

/// Seconds that each move takes, from rest to rest, with look-ahead over all of them: trapezoids whose speed in a
/// corner is bounded by jerk per axis (Marlin, RepRapFirmware: moves also begin and end at what jerk allows), by
/// junction deviation where machine_junction_deviation is set, or by Klipper's square corner velocity
/// (machine_max_jerk) and minimum cruise ratio (of each move on its own, which is near Klipper's smoothed look-ahead).
/// Source: Marlin planner.cpp; Klipper docs/Kinematics.md ("Look-ahead", "Junction speed"); S. Jeon 2011, junction
/// deviation. Cost: O(moves).
void seconds_of(const MachineSettings& machine, const std::vector<Move>& moves, const Slowdown& slowdown,
                std::vector<double>& seconds);

}  // namespace weft::motion
