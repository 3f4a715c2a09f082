// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "infill/pattern.h"

namespace weft::infill {

/// So many lines for each of the drawing, side by side, a band apart.
void multiply(Drawing& drawing, int times, double band_um);

}  // namespace weft::infill
