// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/stages.h"
#include "settings/settings.h"

namespace weft {
struct Report;
}

namespace weft::pipeline {

/// Puts what an object's sparse infill is like into the report, if none of the objects before has more of it.
/// @param settings  of the object's first layers
void tell_infill(const Settings& settings, const PrintedLayers& layers, Report& report);

}  // namespace weft::pipeline
