// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/escape.h"

#include "core/utf8.h"

#include <algorithm>
#include <array>
#include <iterator>

#include <fmt/format.h>

namespace weft::escape {
namespace {

constexpr std::string_view not_a_character = "\uFFFD";

bool is_control(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
}

std::string percent(char c) {
  return fmt::format("%{:02X}", static_cast<unsigned char>(c));
}

/// A character that a language has a word of its own for.
struct Word {
  char of;
  std::string_view is;
};

/// Each of `words` replaced, what is no UTF-8 by U+FFFD, and other control characters as `control` writes them.
template <class Words, class Control>
std::string replaced(std::string_view text, const Words& words, const Control& control) {
  std::string out;
  out.reserve(text.size() + 2);
  while (!text.empty()) {
    const auto length = utf8_length(text);
    const char c = text.front();
    const auto word = std::find_if(words.begin(), words.end(), [&](const Word& w) { return w.of == c; });
    if (length == 0)
      out += percent(c);
    else if (word != words.end())
      out += word->is;
    else if (is_control(c))
      out += control(c);
    else
      out += text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

constexpr auto question_mark = [](char) { return std::string_view("?"); };

constexpr std::array xml_words{Word{'&', "&amp;"},  Word{'<', "&lt;"},   Word{'>', "&gt;"}, Word{'"', "&quot;"},
                               Word{'\n', "&#10;"}, Word{'\r', "&#13;"}, Word{'\t', "&#9;"}};
constexpr std::array html_words{Word{'&', "&amp;"},  Word{'<', "&lt;"},   Word{'>', "&gt;"},   Word{'"', "&quot;"},
                                Word{'\'', "&#39;"}, Word{'\n', "&#10;"}, Word{'\r', "&#13;"}, Word{'\t', "&#9;"}};
constexpr std::array json_words{Word{'"', "\\\""}, Word{'\\', "\\\\"}, Word{'<', "\\u003c"},
                                Word{'\n', "\\n"}, Word{'\r', "\\r"},  Word{'\t', "\\t"}};

}  // namespace

std::string utf8(std::string_view text) {
  if (is_utf8(text)) return std::string(text);
  std::string out;
  while (!text.empty()) {
    const auto length = utf8_length(text);
    if (length == 0)
      out += percent(text.front());
    else
      out += text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return out;
}

std::string xml(std::string_view text) {
  std::string out = replaced(text, xml_words, question_mark);
  for (const std::string_view never : {"\uFFFE", "\uFFFF"})  // the two that XML leaves out of Unicode
    for (std::size_t at = 0; (at = out.find(never, at)) != std::string::npos;)
      out.replace(at, never.size(), not_a_character);
  return out;
}

std::string html(std::string_view text) {
  return replaced(text, html_words, question_mark);
}

std::string json(std::string_view text) {
  const auto by_number = [](char c) { return fmt::format("\\u{:04x}", static_cast<unsigned char>(c)); };
  return fmt::format("\"{}\"", replaced(text, json_words, by_number));
}

std::string script(std::string_view json_text) {
  std::string out;
  for (const char c : json_text)
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  return out;
}

namespace {

/// What a spreadsheet would take for a formula and reckon, or run: not a number with its sign.
bool begins_a_formula(std::string_view text) {
  constexpr std::string_view beginnings = "=+-@\t\r";
  if (text.empty() || beginnings.find(text.front()) == std::string_view::npos) return false;
  return text.front() != '-' || text.size() == 1 || text.find_first_not_of("0123456789.", 1) != std::string_view::npos;
}

}  // namespace

std::string csv(std::string_view text) {
  const bool formula = begins_a_formula(text);
  if (!formula && text.find_first_of(",\"\r\n") == std::string_view::npos) return utf8(text);
  std::string out = formula ? "\"'" : "\"";
  for (const char c : utf8(text)) out.append(c == '"' ? 2 : 1, c);
  out += '"';
  return out;
}

std::string gcode_comment(std::string_view text) {
  constexpr std::array words{Word{'\n', "\\n"}, Word{'\r', "\\r"}, Word{'\t', "\\t"}, Word{'\\', "\\\\"}};
  std::string out;
  for (const char c : text) {
    const auto word = std::find_if(words.begin(), words.end(), [&](const Word& w) { return w.of == c; });
    out += word == words.end() ? std::string_view(&c, 1) : word->is;
  }
  return out;
}

std::string one_line(std::string_view text) {
  std::string out(text);
  std::replace_if(out.begin(), out.end(), is_control, '_');
  return out;
}

std::string gcode_name(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (is_control(c) || std::string_view(";\"'\\{}[]*").find(c) != std::string_view::npos) c = '_';
  return out;
}

std::string message(std::string_view word) {
  std::string out = "'";
  for (const char c : word.substr(0, 40)) out += is_control(c) ? '?' : c;
  return out + (word.size() > 40 ? "...'" : "'");
}

}  // namespace weft::escape
