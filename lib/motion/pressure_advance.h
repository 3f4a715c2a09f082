// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "motion/kinematics.h"
#include "motion/timed_steps.h"
#include "settings/groups/material.h"

namespace weft::motion {

/// The advance of a filament, s, at that flow and acceleration (and height of layers, where its rows tell one): along
/// each a cubic that goes through what was measured and has no hump of its own; beyond what was measured, what is
/// nearest to it. Pre: rows are not empty.
/// Source: Fritsch & Carlson 1980, "Monotone piecewise cubic interpolation"; slopes by harmonic means (Fritsch &
/// Butland 1984).
double pressure_advance_s(const PressureRows& rows, double mm3_s, double mm_s2, Um height);

/// Does any tool of the layer have a model?
bool tells_pressure_advance(const AllRules& all, const LayerPlan& layer);

/// Puts SetPressureAdvance steps before beads: by the flow that the planner gives each of them, weighted by volume, and
/// its acceleration; where it differs by pressure_advance_step from what is told already. Klipper takes it anywhere;
/// other firmware empties its planner for it, so it is told only before a way to a bead.
/// @param moves, seconds of the layer as it is  Post: the layer's steps but for those put in are what they were
void tell_pressure_advance(const AllRules& all, const LayerPlan& layer, const std::vector<Move>& moves,
                           const std::vector<double>& seconds, TimedSteps& steps);

}  // namespace weft::motion
