// SPDX-License-Identifier: GPL-3.0-or-later
#include "macro/value.h"

#include "core/number.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace weft::macro {
namespace {

std::string without_zeros(std::string text) {
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text == "-0" ? "0" : text;
}

std::string number_text(double v) {
  if (v == 0) return "0";
  auto text = fmt::format("{:.6g}", v);
  if (text.find('e') == std::string::npos) return text;
  return without_zeros(fmt::format("{:.{}f}", v, std::abs(v) < 1 ? 10 : 3));
}

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

Scalar bare(std::string_view text) {
  if (text == "true") return true;
  if (text == "false") return false;
  if (text == "nil") return Nil{};
  const auto digits = !text.empty() && text.back() == '%' ? text.substr(0, text.size() - 1) : text;
  if (const auto whole = as_number<std::int64_t>(digits)) return *whole;
  // "inf" and "nan" are numbers to C++, and words here.
  if (digits.find_first_not_of("0123456789+-.eE") == std::string_view::npos)
    if (const auto number = as_number<double>(digits); number && std::isfinite(*number)) return *number;
  return std::string(text);
}

}  // namespace

std::string text_of(const Scalar& value) {
  struct {
    std::string operator()(Nil) const { return "nil"; }
    std::string operator()(bool v) const { return v ? "true" : "false"; }
    std::string operator()(std::int64_t v) const { return fmt::format("{}", v); }
    std::string operator()(double v) const { return number_text(v); }
    std::string operator()(const std::string& v) const { return v; }
  } print;
  return std::visit(print, value);
}

Variable variable(Scalar value) {
  Variable out;
  out.values.push_back(std::move(value));
  return out;
}

Variable variable_of(std::string_view ini_text) {
  Variable out;
  out.text = std::string(ini_text);
  std::size_t i = 0;
  for (;;) {
    while (i < ini_text.size() && (ini_text[i] == ' ' || ini_text[i] == '\t')) ++i;
    if (i < ini_text.size() && ini_text[i] == '"') {
      std::string text;
      for (++i; i < ini_text.size() && ini_text[i] != '"'; ++i) {
        if (ini_text[i] == '\\' && i + 1 < ini_text.size() && (ini_text[i + 1] == '"' || ini_text[i + 1] == '\\')) ++i;
        text += ini_text[i];
      }
      out.values.emplace_back(std::move(text));
      i = std::min(ini_text.find(',', i), ini_text.size());
    } else {
      const auto end = std::min(ini_text.find(',', i), ini_text.size());
      out.values.push_back(bare(trimmed(ini_text.substr(i, end - i))));
      i = end;
    }
    if (i >= ini_text.size()) break;
    ++i;  // the comma
  }
  // Quotes are of the ini, not of the value.
  if (out.values.size() == 1)
    if (const auto* text = std::get_if<std::string>(&out.values[0])) out.text = *text;
  return out;
}

std::string nearest_name(std::string_view wrong, const std::vector<std::string_view>& names) {
  std::string_view best;
  std::size_t least = std::min<std::size_t>(4, 1 + wrong.size() / 3);  // more edits than that is another word
  std::vector<std::size_t> row;
  for (const auto name : names) {
    row.resize(name.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < wrong.size(); ++i) {
      std::size_t diagonal = row[0];
      row[0] = i + 1;
      for (std::size_t k = 0; k < name.size(); ++k) {
        const std::size_t change = diagonal + (wrong[i] == name[k] ? 0u : 1u);
        diagonal = row[k + 1];
        row[k + 1] = std::min({change, row[k] + 1, diagonal + 1});
      }
    }
    if (row.back() <= least && (row.back() < least || best.empty())) best = name, least = row.back();
  }
  return std::string(best);
}

}  // namespace weft::macro
