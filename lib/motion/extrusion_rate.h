// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "motion/motion.h"

/// The pressure in a nozzle follows what is asked of it late. Where mm³/s change no faster than it does, beads are as
/// wide as they are meant.
namespace weft::motion {

/// Does any tool of the layer ask for it?
bool limits_extrusion_rate(const AllRules& all, const LayerPlan& layer);

/// Lowers speeds until mm³/s grow no faster than max_extrusion_rate_slope and fall no faster than
/// max_extrusion_rate_slope_down, all along beads that follow each other without a retraction and with less than 3 mm
/// of travel between them. Where that asks for it moves are cut: a move has one speed. What is faster gives way,
/// nothing is ever raised, and nothing is lowered below cool_min_speed. Pre:  speeds are set, and slowed down for the
/// layer to cool; no arcs are fitted yet. Post: flow is linear in time where it changes: along a piece of volume V its
/// square changes by 2·slope·V at most. Cost: O(junctions). Source: flow that is linear in time over a volume V, from
/// q₀ to q₁, takes 2V/(q₀ + q₁), so that its slope is (q₁² − q₀²)/2V: the look-ahead of speeds along lengths, with flow
/// along volume in its place.
void limit_extrusion_rate(const AllRules& all, LayerPlan& layer);

}  // namespace weft::motion
