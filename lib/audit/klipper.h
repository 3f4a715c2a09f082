// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <optional>
#include <string>
#include <string_view>

/// How Klipper's host reads the arguments of its extended commands (`SET_GCODE_OFFSET X=5 MOVE=1`), to the letter: what
/// the audit reads otherwise than the firmware, it does not see. Source: the behaviour of klippy/gcode.py, which splits
/// with Python's shlex in POSIX mode and reads numbers with Python's float() and int().
namespace weft::audit::klipper {

/// KEY → value; keys in upper case, values without quotes. Of a key given twice the last counts.
using Arguments = std::map<std::string, std::string, std::less<>>;

/// The arguments behind the command's name. Quotes ' and ", backslashes, and comments behind # or ; as in a shell; a ;
/// within quotes is no comment.
/// @return nullopt when Klipper refuses the command: a quote that is not closed, an argument without `=`, and bytes
///   beyond ASCII in a key, which Python's upper() may turn into any letter
std::optional<Arguments> arguments_of(std::string_view text);

/// What Python's float() makes of the text; may be infinite or no number. nullopt: float() raises an error, or the text
/// holds bytes beyond ASCII.
std::optional<double> number_of(std::string_view text);

/// What Python's int() makes of the text; nullopt as above, and beyond a machine's int.
std::optional<int> integer_of(std::string_view text);

}  // namespace weft::audit::klipper
