#pragma once
#include "preview/preview.h"

#include <string>
#include <string_view>

namespace weft::app {

/// The kind of preview that a destination's extension asks for. @throws Error{usage} for another extension
preview::Kind preview_kind(const std::string& destination);

/// Draws finished G-code to a file of that kind. @throws Error{file}, Error{usage}
void write_preview(const std::string& destination, std::string_view gcode, Um filament_diameter,
                   const std::string& title);

}  // namespace weft::app
