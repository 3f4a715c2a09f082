// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "motion/motion.h"

namespace weft::motion {

/// Brings the curved stretches of a bead nearer to one speed, by speed_curvature_even: at 100 % each is as fast as the
/// slowest of its corners may be taken. A planner that slows down at some of a curve's corners and not at others lets
/// the wall shine in stripes. A stretch is three moves or more of up to 10 mm, each turning by up to 30°.
/// Pre:    speeds and acceleration are set. Cost: O(junctions).
/// Source: the speed of a corner as the machine's firmware bounds it (kinematics.h); gloss of plastic by the speed it
///         was laid at: what is held constant here is that.
void even_curves(const Rules& rules, Extrude& bead);

}  // namespace weft::motion
