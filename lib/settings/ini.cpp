// SPDX-License-Identifier: GPL-3.0-or-later
#include "settings/ini.h"

#include "core/error.h"
#include "core/utf8.h"
#include "settings/value.h"

#include <algorithm>

#include <fmt/format.h>

namespace weft {
namespace {

constexpr std::size_t longest_line = 1 << 20;

}  // namespace

std::vector<IniEntry> parse_ini(std::string_view text, const std::string& path) {
  std::vector<IniEntry> entries;
  std::string section;
  int number = 0;
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);  // byte-order mark
  while (!text.empty()) {
    ++number;
    const auto end = text.find('\n');
    const auto raw = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    const auto refuse = [&](std::string what, std::string hint) {
      throw Error{Error::Kind::settings, std::move(what), fmt::format("{}:{}", path, number), std::move(hint)};
    };
    if (raw.size() > longest_line) refuse("the line is longer than 1 MB", "is this a profile?");
    if (raw.find('\0') != std::string_view::npos) refuse("a NUL byte", "is this a text file?");
    if (!is_utf8(raw)) refuse("the text is not UTF-8", "save the profile as UTF-8");
    const auto line = value::trimmed(raw);
    if (line.empty() || line.front() == ';' || line.front() == '#') continue;
    if (line.front() == '[' && line.back() == ']') {
      section = std::string(value::trimmed(line.substr(1, line.size() - 2)));
      continue;
    }
    const auto equals = line.find('=');
    if (equals == std::string_view::npos)
      refuse("the line is not 'key = value'", "comments begin with ';' or '#'");  // nor said: of whose file is it?
    const auto key = value::trimmed(line.substr(0, equals));
    if (key.empty()) refuse("there is no key before '='", "");
    entries.push_back({section, std::string(key), std::string(value::trimmed(line.substr(equals + 1))), number});
  }
  return entries;
}

}  // namespace weft
