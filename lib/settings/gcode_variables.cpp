// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/gcode_variables.h"

#include "settings/value.h"

#include <stdexcept>

#include <fmt/format.h>

namespace weft {
namespace {

using value::trimmed;

/// Takes one value off the front of `rest`, and the comma behind it. @return false: something else stands there
bool take_element(std::string_view& rest, GcodeVariable::Element& out) {
  rest = trimmed(rest);
  if (rest.empty() || rest.front() != '"') {
    const auto comma = rest.find(',');
    out = {std::string(trimmed(rest.substr(0, comma))), false};
    if (out.text.empty() || out.text.find('"') != std::string::npos) return false;
    rest.remove_prefix(comma == std::string_view::npos ? rest.size() : comma + 1);
    return true;
  }
  out = {{}, true};
  std::size_t i = 1;
  for (; i < rest.size() && rest[i] != '"'; ++i) {
    if (rest[i] == '\\' && i + 1 < rest.size()) {
      const char c = rest[++i];
      out.text += c == 'n' ? '\n' : c;
    } else {
      out.text += rest[i];
    }
  }
  if (i == rest.size()) return false;
  rest = trimmed(rest.substr(i + 1));
  if (rest.empty()) return true;
  if (rest.front() != ',') return false;
  rest.remove_prefix(1);
  return true;
}

}  // namespace

std::vector<GcodeVariable> parse_gcode_variables(std::string_view text) {
  std::vector<GcodeVariable> out;
  for (int number = 1; !text.empty(); ++number) {
    const auto end = text.find('\n');
    const auto line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty()) continue;
    const auto equals = line.find('=');
    const auto name = trimmed(line.substr(0, equals));
    if (equals == std::string_view::npos || name.empty() ||
        name.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_0123456789") !=
            std::string_view::npos)
      throw std::invalid_argument(fmt::format("line {}, '{}', is not 'name = value'", number, line.substr(0, 40)));
    GcodeVariable variable{std::string(name), {}};
    for (auto rest = trimmed(line.substr(equals + 1)); !rest.empty();)
      if (!take_element(rest, variable.elements.emplace_back()))
        throw std::invalid_argument(fmt::format("line {}: '{}' is not a value or a list of values", number,
                                                trimmed(line.substr(equals + 1)).substr(0, 40)));
    out.push_back(std::move(variable));
  }
  return out;
}

std::string quoted_variable(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (c == '\n')
      out += "\\n";
    else
      out += c;
  }
  return out + "\"";
}

}  // namespace weft
