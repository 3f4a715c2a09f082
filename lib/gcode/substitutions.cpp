// SPDX-License-Identifier: GPL-3.0-or-later
#include "gcode/substitutions.h"

#include "core/error.h"
#include "core/stop.h"
#include "settings/value.h"

#include <cstdint>
#include <optional>

#include <fmt/format.h>

#define PCRE2_CODE_UNIT_WIDTH 8
#include <pcre2.h>

namespace weft::gcode {
namespace {

constexpr std::string_view shape = "s/FIND/REPLACE/FLAGS, as in s/M204 S900/M204 S500/ or s/^M73.*\\n//r";

[[noreturn]] void refuse(std::size_t line, const std::string& what, std::string hint) {
  throw Error{Error::Kind::settings, what, fmt::format("gcode_substitutions, line {}", line), std::move(hint)};
}

/// Up to the next `end` that has no backslash before it; the rest without it. Nothing where there is none.
std::optional<std::string> taken(std::string_view& rest, char end) {
  std::string out;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    if (rest[i] == end) return rest.remove_prefix(i + 1), out;
    if (rest[i] == '\\' && i + 1 < rest.size()) {
      if (rest[i + 1] != end) out += '\\';
      ++i;
    }
    out += rest[i];
  }
  return std::nullopt;
}

/// A plain text, of which backslashes are read as in C.
std::string plain(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool meant = text[i] == '\\' && i + 1 < text.size();
    const char next = meant ? text[i + 1] : '\0';
    const char c = next == 'n' ? '\n' : next == 't' ? '\t' : next == 'r' ? '\r' : next == '\\' ? '\\' : '\0';
    if (c != '\0') ++i;
    out += c != '\0' ? c : text[i];
  }
  return out;
}

std::string message_of(int code) {
  constexpr std::size_t longest = 256;  // no message of PCRE2 is longer
  std::string out(longest, '\0');
  const int size = pcre2_get_error_message(code, reinterpret_cast<PCRE2_UCHAR*>(out.data()), out.size());
  out.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
  return out;
}

PCRE2_SPTR bytes(std::string_view text) {
  return reinterpret_cast<PCRE2_SPTR>(text.data());
}

struct Free {
  void operator()(pcre2_code* code) const { pcre2_code_free(code); }
  void operator()(pcre2_match_context* context) const { pcre2_match_context_free(context); }
};

}  // namespace

struct Substitutions::One {
  std::size_t line = 0;
  std::unique_ptr<pcre2_code, Free> find;
  std::string replace;
  std::uint32_t options = 0;  ///< of pcre2_substitute
};

Substitutions::~Substitutions() = default;

Substitutions::Substitutions(std::string_view setting) {
  for (std::size_t number = 1; !setting.empty(); ++number) {
    const auto end = std::min(setting.find('\n'), setting.size());
    auto line = value::trimmed(setting.substr(0, end));
    setting.remove_prefix(std::min(end + 1, setting.size()));
    if (line.empty()) continue;
    if (line.size() < 2 || line[0] != 's' || line[1] == '\\')
      refuse(number, fmt::format("'{}' is no substitution", line), std::string(shape));
    const char slash = line[1];
    line.remove_prefix(2);
    auto find = taken(line, slash), replace = taken(line, slash);
    if (!find || !replace) refuse(number, fmt::format("a '{}' is missing", slash), std::string(shape));
    if (find->empty()) refuse(number, "there is nothing to look for", std::string(shape));
    if (const auto odd = line.find_first_not_of("riws"); odd != std::string_view::npos)
      refuse(number, fmt::format("'{}' is no flag", line[odd]), "r, i, w and s are");
    const auto has = [&](char flag) { return line.find(flag) != std::string_view::npos; };
    std::uint32_t options = PCRE2_MULTILINE | (has('i') ? PCRE2_CASELESS : 0U) | (has('s') ? PCRE2_DOTALL : 0U);
    One one{.line = number, .find = {}, .replace = has('r') ? *replace : plain(*replace), .options = 0};
    one.options = PCRE2_SUBSTITUTE_GLOBAL | (has('r') ? PCRE2_SUBSTITUTE_EXTENDED : PCRE2_SUBSTITUTE_LITERAL);
    std::string pattern = *find;
    if (!has('r')) {  // \Q…\E would end at a \E in it
      pattern.clear();
      for (const char c : plain(*find)) pattern += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    }
    if (has('w')) pattern = R"(\b(?:)" + pattern + R"()\b)";
    int problem = 0;
    PCRE2_SIZE at = 0;
    one.find.reset(pcre2_compile(bytes(pattern), pattern.size(), options, &problem, &at, nullptr));
    if (!one.find) refuse(number, fmt::format("{} (at character {})", message_of(problem), at), "see man pcre2pattern");
    all_.push_back(std::move(one));
  }
}

std::string Substitutions::done(std::string text) const {
  if (all_.empty()) return text;
  const std::unique_ptr<pcre2_match_context, Free> context(pcre2_match_context_create(nullptr));
  constexpr std::size_t most_growth = 16;  // of a layer's text: lines that double each other fill any memory
  constexpr std::uint32_t most_steps = 10'000'000, most_kb = 64'000;  // of one match: an expression that runs wild ends
  pcre2_set_match_limit(context.get(), most_steps);
  pcre2_set_heap_limit(context.get(), most_kb);
  const std::size_t most = most_growth * text.size() + (std::size_t{1} << 20);
  std::string out;
  for (const auto& one : all_) {
    stop_if_asked();
    PCRE2_SIZE size = text.size() + text.size() / 8 + 256;
    int result = PCRE2_ERROR_NOMEMORY;
    for (int tries = 0; result == PCRE2_ERROR_NOMEMORY && tries < 2; ++tries) {
      if (tries > 0 && size > most)
        refuse(one.line, fmt::format("makes {} MB of {} bytes", size >> 20, text.size()), "replace by less");
      out.resize(size);
      size = out.size();
      result = pcre2_substitute(
          one.find.get(), bytes(text), text.size(), 0, one.options | PCRE2_SUBSTITUTE_OVERFLOW_LENGTH, nullptr,
          context.get(), bytes(one.replace), one.replace.size(), reinterpret_cast<PCRE2_UCHAR*>(out.data()), &size);
    }
    if (result < 0)
      refuse(one.line, fmt::format("{}", message_of(result)),
             result == PCRE2_ERROR_MATCHLIMIT || result == PCRE2_ERROR_HEAPLIMIT
                 ? "the expression tries too many ways; say more exactly what it looks for"
                 : "in REPLACE, $ and \\ have a meaning; write $$ and \\\\ for themselves");
    out.resize(size);
    text.swap(out);
  }
  return text;
}

}  // namespace weft::gcode
