// SPDX-License-Identifier: GPL-3.0-or-later
#include "audit/klipper.h"

#include "audit/scan.h"

#include <algorithm>
#include <charconv>
#include <limits>

namespace weft::audit::klipper {
namespace {

constexpr bool is_ascii(std::string_view text) {
  return std::none_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) >= 0x80; });
}

/// White space between arguments.
constexpr bool separates(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/// White space that Python's strip() takes off.
constexpr bool is_stripped(char c) {
  return separates(c) || c == '\v' || c == '\f' || (c >= '\x1c' && c <= '\x1f');
}

std::string_view stripped(std::string_view text) {
  while (!text.empty() && is_stripped(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_stripped(text.back())) text.remove_suffix(1);
  return text;
}

/// Takes one word as a POSIX shell quotes it off the front of `text`, into `word`.
/// @return false when a quote or a backslash has nothing behind it
bool take_word(std::string_view& text, std::string& word, bool& ended) {
  word.clear();
  char quote = '\0';
  bool any = false;
  for (; !text.empty(); text.remove_prefix(1)) {
    const char c = text.front();
    if (quote != '\0') {
      if (c == quote) {
        quote = '\0';
      } else if (c == '\\' && quote == '"') {
        if (text.size() == 1) return false;
        text.remove_prefix(1);
        if (text.front() != '"' && text.front() != '\\') word += '\\';
        word += text.front();
      } else {
        word += c;
      }
    } else if (separates(c)) {
      if (any) return true;
    } else if (c == '#' || c == ';') {
      text = {};
      break;
    } else if (c == '\\') {
      if (text.size() == 1) return false;
      text.remove_prefix(1);
      word += text.front(), any = true;
    } else if (c == '\'' || c == '"') {
      quote = c, any = true;
    } else {
      word += c, any = true;
    }
  }
  ended = !any;
  return quote == '\0';
}

/// Takes the underscores out that Python allows between two digits.
std::optional<std::string> without_underscores(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '_') {
      out += text[i];
    } else if (i == 0 || i + 1 == text.size() || !scan::is_digit(text[i - 1]) || !scan::is_digit(text[i + 1])) {
      return std::nullopt;
    }
  }
  return out;
}

}  // namespace

std::optional<Arguments> arguments_of(std::string_view text) {
  Arguments out;
  std::string word;
  for (bool ended = false;;) {
    if (!take_word(text, word, ended)) return std::nullopt;
    if (ended) return out;
    const auto equals = word.find('=');
    if (equals == std::string::npos) return std::nullopt;
    auto key = word.substr(0, equals);
    if (!is_ascii(key)) return std::nullopt;
    std::transform(key.begin(), key.end(), key.begin(), scan::upper);
    out.insert_or_assign(std::move(key), word.substr(equals + 1));
  }
}

std::optional<double> number_of(std::string_view text) {
  text = stripped(text);
  if (!is_ascii(text) || text.find_first_of("()") != std::string_view::npos) return std::nullopt;
  auto digits = without_underscores(text);
  if (!digits) return std::nullopt;
  std::string_view rest = *digits;
  const bool negative = rest.starts_with('-');
  if (negative || rest.starts_with('+')) rest.remove_prefix(1);
  if (rest.empty() || rest.front() == '-' || rest.front() == '+') return std::nullopt;
  double v = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), v);
  if (end != rest.data() + rest.size() || error == std::errc::invalid_argument) return std::nullopt;
  // Out of range: too large or too small to be told apart from zero. Either is no number that a file needs.
  if (error != std::errc{}) v = std::numeric_limits<double>::infinity();
  return negative ? -v : v;
}

std::optional<int> integer_of(std::string_view text) {
  const auto digits = is_ascii(text) ? without_underscores(stripped(text)) : std::nullopt;
  if (!digits) return std::nullopt;
  std::string_view rest = *digits;
  if (rest.starts_with('+')) rest.remove_prefix(1);
  if (rest.starts_with('-') && rest.size() != digits->size()) return std::nullopt;  // "+-1"
  int v = 0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), v);
  if (end != rest.data() + rest.size() || error != std::errc{}) return std::nullopt;
  return v;
}

}  // namespace weft::audit::klipper
