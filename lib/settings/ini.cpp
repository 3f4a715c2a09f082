#include "settings/ini.h"

#include "core/error.h"
#include "settings/value.h"

#include <algorithm>

#include <fmt/format.h>

namespace weft {
namespace {

constexpr std::size_t longest_line = 1 << 20;

/// Length of the valid UTF-8 sequence at the front of `text`, or 0. Source: RFC 3629, section 4.
std::size_t utf8_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto tail = [&](std::size_t i) { return (byte(i) & 0xC0u) == 0x80u; };
  const unsigned a = byte(0), b = byte(1);
  if (a < 0x80) return 1;
  if (a >= 0xC2 && a <= 0xDF) return tail(1) ? 2 : 0;
  if (a >= 0xE0 && a <= 0xEF) {
    if ((a == 0xE0 && b < 0xA0) || (a == 0xED && b > 0x9F)) return 0;
    return tail(1) && tail(2) ? 3 : 0;
  }
  if (a >= 0xF0 && a <= 0xF4) {
    if ((a == 0xF0 && b < 0x90) || (a == 0xF4 && b > 0x8F)) return 0;
    return tail(1) && tail(2) && tail(3) ? 4 : 0;
  }
  return 0;
}

}  // namespace

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const auto n = utf8_length(text);
    if (n == 0) return false;
    text.remove_prefix(n);
  }
  return true;
}

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
      refuse(fmt::format("'{}' is not 'key = value'", line.substr(0, 60)), "comments begin with ';' or '#'");
    const auto key = value::trimmed(line.substr(0, equals));
    if (key.empty()) refuse("there is no key before '='", "");
    entries.push_back({section, std::string(key), std::string(value::trimmed(line.substr(equals + 1))), number});
  }
  return entries;
}

}  // namespace weft
