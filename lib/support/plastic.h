// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/groups/support.h"
#include "support/support.h"

namespace weft::support {

/// The width that a bead of support fills with nothing rounded, in layers as high as most are, µm.
Um usual_band(const SupportSettings& settings, Um nozzle);

/// What the beads of an area of columns of that height take, mm³: a loop where it is narrow, else lines. What joins
/// these at every other end makes up for the half bead by which they end before the edge.
double column_mm3(const SupportSettings& settings, Um nozzle, const Region& area, Um height);

/// What the beads of a plan take, mm³, reckoned from its areas. Cost: an offset a column.
double plastic_mm3(const SupportSettings& settings, Um nozzle, const Plan& plan);

}  // namespace weft::support
