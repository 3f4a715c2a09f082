// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "audit/audit.h"

#include <filesystem>

namespace weft {

/// The door through which G-code leaves the program, of every verb: only the audit makes what it takes.
/// @param destination  a file, which is written as write_file does; "-" is standard output
/// @throws Error{file}
void write_gcode(const std::filesystem::path& destination, const audit::Passed& gcode);

}  // namespace weft
