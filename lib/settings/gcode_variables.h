// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace weft {

/// A further name that custom G-code may use, and its values: numbers and other words as they stand, texts without
/// their quotes.
struct GcodeVariable {
  std::string name;
  struct Element {
    std::string text;
    bool quoted = false;
  };
  std::vector<Element> elements;
};

/// Reads the lines of `gcode_variables`: `name = value` or `name = value, value`; a text stands in quotes, in which
/// `\"`, `\\` and `\n` mean what they usually do.
/// @throws std::invalid_argument with one clause that names the line
std::vector<GcodeVariable> parse_gcode_variables(std::string_view text);

/// A text in the quotes that parse_gcode_variables takes off again.
std::string quoted_variable(std::string_view text);

}  // namespace weft
