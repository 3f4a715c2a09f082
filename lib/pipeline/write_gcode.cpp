// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/write_gcode.h"

#include "core/write_file.h"

namespace weft {

void write_gcode(const std::filesystem::path& destination, const audit::Passed& gcode) {
  if (destination == "-")
    write_standard_output(gcode.gcode());
  else
    write_file(destination, gcode.gcode());
}

}  // namespace weft
