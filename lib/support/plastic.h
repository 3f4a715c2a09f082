// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/groups/support.h"
#include "support/support.h"

namespace weft::support {

/// What the beads of an area of columns of that height take, mm³: a loop where it is narrow, else lines and what joins
/// them at every other end.
/// @param line  width of a bead, µm
double column_mm3(const SupportSettings& settings, Um line, const Region& area, Um height);

/// What the beads of a plan take, mm³, reckoned from its areas. Cost: an offset a column.
double plastic_mm3(const SupportSettings& settings, Um nozzle, const Plan& plan);

}  // namespace weft::support
