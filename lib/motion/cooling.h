// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "motion/kinematics.h"

namespace weft::motion {

/// How many layers a layer is to the plastic that has to set: two where a vase's last turn lies on the one before it
/// (travel/spiral.h), else one.
std::size_t times_laid(const LayerPlan& layer);

/// How much printing must be slowed down so that the moves take so many times cool_min_layer_time, to 0.01 s; as far as
/// cool_min_speed lets it. No slow-down when they do already.
Slowdown slowdown_for(const Rules& rules, const std::vector<Move>& moves, double seconds_now, std::size_t times = 1);

/// Applies it to the beads of a layer.
void slow_down(LayerPlan& layer, const Slowdown& slowdown);

/// The fan of a layer that takes so long, 0 … 1.
/// @param number of the layer on its way up from the bed (Moment)
double fan_share(const CoolingSettings& cooling, std::size_t number, double seconds);

/// Puts SetFan steps in: for the layer, and around bridges, overhangs, and interfaces of support and what lies on them.
void set_fan(const CoolingSettings& cooling, LayerPlan& layer, double seconds);

}  // namespace weft::motion
