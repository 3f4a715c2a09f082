// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <filesystem>
#include <string_view>

namespace weft {

/// Bytes of a name that stand in that of its neighbour, NAME.weft-XXXXXX: a system takes 255.
inline constexpr std::size_t most_of_name = 243;

// For reports and pictures. G-code leaves the program through write_gcode.h and nowhere else.

/// Writes beside the destination and renames when every byte is there: the file is the old one or the new one, never
/// half. A symbolic link is followed. A destination that exists and is no regular file (a pipe, /dev/null) is written
/// straight.
/// @throws Error{file}; the destination is then as it was
void write_file(const std::filesystem::path& destination, std::string_view bytes);

/// Writes to standard output, whole. @throws Error{file}
void write_standard_output(std::string_view bytes);

}  // namespace weft
