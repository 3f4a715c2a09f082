// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "audit/audit.h"
#include "preview/preview.h"
#include "settings/settings.h"

#include <string>
#include <vector>

namespace weft::app {

/// The kind of preview that a destination's extension asks for. @throws Error{usage} for another extension
preview::Kind preview_kind(const std::string& destination);

/// Draws finished G-code to a file of that kind; a page holds what the audit has found, and the models.
/// @throws Error{file}, Error{usage}
void write_preview(const std::string& destination, const audit::Passed& gcode, const Settings& settings,
                   const std::string& title, const std::vector<std::string>& models);

/// The diameter of filament that makes E what the G-code means: of 1 mm² where E is in mm³.
inline Um diameter_of_e(const Settings& settings) {
  constexpr Um of_a_square_mm = 1128;
  return settings.gcode.volumetric_extrusion ? of_a_square_mm : settings.material.filament_diameter;
}

}  // namespace weft::app
