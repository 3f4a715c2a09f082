// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/microns.h"

#include <optional>
#include <string_view>

namespace weft::gcode {

/// What start G-code leaves to the first travel.
struct LeftBehind {
  std::optional<Um> z;       ///< height of the nozzle; nothing: not known
  double drawn_mm = 0;       ///< filament drawn back and not pushed forward again
  bool by_firmware = false;  ///< drawn back by G10
};

/// Reads G0 to G3, G10, G11, G28, G90 to G92, M82 and M83. What homes stands at Z 0; a command that it does not know
/// and that may move the nozzle (G29, a macro) leaves Z unknown and the filament where it was. Pre: expanded, lines end
/// with '\n'. Cost: linear.
LeftBehind left_by(std::string_view code);

}  // namespace weft::gcode
