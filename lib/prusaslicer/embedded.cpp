// SPDX-License-Identifier: GPL-3.0-or-later
#include "prusaslicer/embedded.h"

#include "core/error.h"
#include "core/utf8.h"
#include "settings/value.h"

#include <algorithm>

#include <fmt/format.h>

namespace weft::prusaslicer {
namespace {

using value::trimmed;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Is the first line that is no comment a command, `G28` or `M73 P0`? No ini's key begins like that.
/// A 3MF's configuration has comments only, all of the form `; key = value`.
bool is_gcode(std::string_view text) {
  std::size_t settings = 0;
  for (int lines = 0; !text.empty() && lines < 100000; ++lines) {
    const auto end = text.find('\n');
    const auto line = trimmed(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.empty() || line.front() == '#') continue;
    if (line.front() == ';') {
      settings += line.find(" = ") != std::string_view::npos ? 1u : 0u;
      continue;
    }
    const bool command =
        line.size() > 1 && std::string_view("GMTN").find(line[0]) != std::string_view::npos && is_digit(line[1]);
    return command || (line.find('=') == std::string_view::npos && settings > 0 &&
                       line.front() != '[');  // a macro such as PRINT_START
  }
  return settings >= 20;
}

bool is_key(std::string_view key) {
  return !key.empty() &&
         std::all_of(key.begin(), key.end(), [](char c) { return (c >= 'a' && c <= 'z') || is_digit(c) || c == '_'; });
}

constexpr std::size_t margin = 4 << 20;

}  // namespace

std::optional<std::vector<IniEntry>> embedded_config(std::string_view text, const std::string& path) {
  if (text.starts_with("GCDE"))
    throw Error{Error::Kind::settings, "is binary G-code, whose configuration weft does not read", path,
                "export text G-code, or the configuration itself"};
  if (!is_gcode(text.substr(0, margin))) return std::nullopt;
  std::vector<IniEntry> all, marked;
  bool inside = false;
  int number = 0;
  std::size_t position = 0;
  const std::size_t whole = text.size();
  while (!text.empty()) {
    ++number;
    const auto end = text.find('\n');
    const auto raw = text.substr(0, end);
    const bool skipped = position > margin && position + margin < whole;
    position += raw.size() + 1;
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (skipped || raw.empty() || raw.front() != ';') continue;
    const auto line = trimmed(raw.substr(1));
    const auto equals = line.find('=');
    if (equals == std::string_view::npos) continue;
    const auto key = trimmed(line.substr(0, equals)), said = trimmed(line.substr(equals + 1));
    if (!is_key(key)) continue;
    if ((key.ends_with("_config") || key == "weft_settings") && (said == "begin" || said == "end")) {
      inside = said == "begin";
      if (inside) marked.clear();
      continue;
    }
    if (!is_utf8(raw))
      throw Error{Error::Kind::settings, "the text is not UTF-8", fmt::format("{}:{}", path, number), {}};
    (inside ? marked : all).push_back({{}, std::string(key), std::string(said), number});
  }
  auto& found = marked.empty() ? all : marked;
  if (found.empty())
    throw Error{Error::Kind::settings, "is G-code without a configuration in its comments", path,
                "weft reads those of PrusaSlicer, SuperSlicer, Slic3r and its own"};
  return std::move(found);
}

}  // namespace weft::prusaslicer
