// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// One `key = value` of an ini file.
struct IniEntry {
  std::string section;  ///< of the last `[section]` line above, or empty
  std::string key, value;
  int line = 0;  ///< counted from 1
};

/// Reads ini text: `key = value` lines, `[section]` lines, blank lines, and comments, which are whole lines that begin
/// with ';' or '#' (a value may hold both, as G-code does). White space around keys and values does not count.
/// @param path as the user typed it, for messages
/// @throws Error{settings} naming path:line: no '=', an empty key, a NUL byte, text that is not UTF-8, a line over 1 MB
std::vector<IniEntry> parse_ini(std::string_view text, const std::string& path);

}  // namespace weft
