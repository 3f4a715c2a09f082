// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "motion/timed_steps.h"

namespace weft::motion {

/// A fan takes time to speed up. What tells it to turn faster moves forward by so much of the planned time, within the
/// layer; where that is in the middle of a bead, the bead is cut. What tells it to turn slower stays, unless it is to
/// turn faster again within that time.
/// Pre: the steps hold SetFan.
void lead_fan(double lead_s, TimedSteps& steps);

}  // namespace weft::motion
