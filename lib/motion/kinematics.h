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
  double asked_mm_s2 = 0;  ///< of it, before the axes bound it
  double e_per_mm = 0;     ///< filament, mm a mm; < 0: drawn back
  double pause_s = 0;      ///< at rest: length is 0
  std::uint32_t step = 0;  ///< of the layer
  bool prints = false;     ///< may be slowed down to let a layer set
};

/// A way in mm.
struct Way {
  double x = 0, y = 0, z = 0;
};
/// What is asked of a move.
struct Asked {
  double speed_mm_s = 0, acceleration_mm_s2 = 0;
  double e_mm = 0;  ///< of filament, spread evenly
};
/// A move within what the axes can do; nothing: it goes nowhere.
std::optional<Move> move_along(const MachineSettings& machine, Way way, const Asked& asked);

/// Seconds that the extruder alone takes for so much filament, from rest to rest.
double extruder_seconds(double mm, double speed_mm_s, const MachineSettings& machine);

/// The moves of a layer with speeds, within what the axes can do.
/// Pre: set_speeds has been applied.
std::vector<Move> moves_of(const AllRules& all, const LayerPlan& layer, std::optional<Point3> start,
                           const MachineSettings& machine);

/// The moves of one bead, its ways to it and from it left out, and the junctions that each ends at.
struct BeadMoves {
  std::vector<Move> moves{};
  std::vector<std::size_t> ends{};
};
/// Pre: the bead has a speed, and no arcs yet.
BeadMoves moves_of(const Rules& rules, const Extrude& bead);

/// How fast a corner may be taken by the rule of the machine's firmware, mm/s.
double corner_speed_mm_s(const MachineSettings& machine, const Move& in, const Move& out);

/// Printing slowed down: nothing is printed faster than this, slower speeds stay. So what is fastest gives first, and
/// outer walls keep their speed, on which their gloss hangs, as long as anything else has time to give.
struct Slowdown {
  double most_mm_s = std::numeric_limits<double>::infinity();
  double of(double speed_mm_s) const;
  bool slows() const { return most_mm_s != std::numeric_limits<double>::infinity(); }
};

/// Seconds that each move takes, from rest to rest, as the machine's firmware plans it: trapezoids whose speed at a
/// corner is bounded
///   Klipper   by square corner velocity, by an arc that leaves both moves within their middles, and by what the
///             filament's speed may change at once; and whose peaks keep the minimum cruise ratio, of a run of moves;
///   Marlin    by jerk per axis, the filament's too (moves also begin and end at what jerk allows), or by junction
///             deviation where machine_junction_deviation is set; with as many moves seen ahead as its buffer holds;
///   RepRapFirmware  by jerk per axis, at one speed for both moves.
/// Source: Klipper docs/Kinematics.md ("Look-ahead", "Junction speed", "Smoothed look-ahead"), Config_Reference.md;
/// Marlin docs "Configuring Marlin: Jerk, Junction Deviation", planner; S. Jeon 2011, junction deviation;
/// RepRapFirmware docs M566. Cost: O(moves).
/// @param steady of each move, the seconds at its highest speed; null: not asked for
void seconds_of(const MachineSettings& machine, const std::vector<Move>& moves, const Slowdown& slowdown,
                std::vector<double>& seconds, std::vector<double>* steady = nullptr);

}  // namespace weft::motion
