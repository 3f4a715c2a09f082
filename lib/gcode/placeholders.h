#pragma once
#include "settings/settings.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace weft::gcode {

/// What placeholders in custom G-code may name. A value is a list of one or more texts; an empty list is a name that is
/// known but has no value (a setting that is `auto`).
using Variables = std::map<std::string, std::vector<std::string>, std::less<>>;

/// Every setting, under weft's name and PrusaSlicer's; first-layer values that are `auto` are resolved. Control
/// characters in values become '_', so that no value can bring a line of its own.
Variables variables_of(const Settings& settings);

/// A text from outside (a file or object name) made harmless: what could end a line, a comment or a quoted string is
/// '_'.
std::string escaped_name(std::string_view name);

/// Custom G-code with its placeholders replaced: `{name}`, `{name[0]}`, `[name]`, `[name_0]`. A '[' that no name
/// follows stands for itself. A list without index gives its values separated by commas.
struct Expansion {
  std::string text;
  std::vector<std::string> used;  ///< names that were replaced, in order
};

/// @param setting name of the setting that holds the text, for messages
/// @throws Error{settings} with setting:line:column: an unknown name (with the nearest known one), a name without
/// value, an
///         index out of range, an expression
Expansion expand(std::string_view text, const Variables& variables, std::string_view setting);

}  // namespace weft::gcode
