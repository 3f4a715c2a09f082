// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "prusaslicer/lines.h"

#include <string_view>

namespace weft::prusaslicer {

/// The cross-section that a line has which is printed at a speed, mm². @param speed our key of it
/// @param nozzle,height mm
double line_area_mm2(Lines& lines, std::string_view speed, double nozzle, double height);

}  // namespace weft::prusaslicer
