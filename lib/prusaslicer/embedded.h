// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "settings/ini.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace weft::prusaslicer {

/// The configuration that a G-code file carries in its comments: PrusaSlicer's and SuperSlicer's between
/// `; prusaslicer_config = begin` and `end`, Slic3r's (and that of a 3MF's Metadata/Slic3r_PE.config) in all its lines
/// `; key = value`, and weft's. Line numbers are those of the file. Nothing when the text is no G-code.
/// @throws Error{settings}: a G-code file without a configuration; text that is not UTF-8
/// Cost: linear; of a large file only the first and the last four megabytes are looked at, as that is where writers put
/// it.
std::optional<std::vector<IniEntry>> embedded_config(std::string_view text, const std::string& path);

}  // namespace weft::prusaslicer
