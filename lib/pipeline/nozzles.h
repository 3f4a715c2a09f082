// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/settings.h"

#include <optional>

namespace weft::pipeline {

/// The diameter of a tool's nozzle, µm; where none is named, the one that the settings say.
/// Pre: the printer has that tool; the settings are the plate's, with no tool's laid over them.
Um nozzle_of(const Settings& plate, std::optional<int> tool);

/// The settings of the support of an object: its lines are those of the nozzles that print it. Of two nozzles the wider
/// says how wide lines are, the narrower how high; what is printed with whichever tool is loaded has the object's own.
/// @param own  of the object
Settings of_support(const Settings& plate, Settings own);

}  // namespace weft::pipeline
