// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "gcode/writer.h"

#include <string>

namespace weft::gcode {

/// What output_filename_format says of a print: the name of a file, without a folder.
/// @throws Error{settings} for what is not of the macro language, or names nothing
std::string file_name(const Job& job);

}  // namespace weft::gcode
