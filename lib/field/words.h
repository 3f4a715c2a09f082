// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/error.h"

#include <algorithm>
#include <charconv>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace weft::field {

/// Lines and words of a text, with the number of the line.
class Words {
 public:
  Words(std::string_view text, const std::string& path) : rest_(text), path_(path) {}

  /// @throws Error{settings} that names the line
  [[noreturn]] void refuse(std::string problem, std::string hint = {}) const {
    throw Error{Error::Kind::settings, std::move(problem), fmt::format("{}:{}", path_, line_), std::move(hint)};
  }
  /// @throws Error{settings} that names the file
  [[noreturn]] void refuse_all(std::string problem, std::string hint = {}) const {
    throw Error{Error::Kind::settings, std::move(problem), path_, std::move(hint)};
  }
  std::string_view line() {
    const std::size_t end = std::min(rest_.size(), rest_.find('\n'));
    std::string_view out = rest_.substr(0, end);
    rest_.remove_prefix(std::min(rest_.size(), end + 1)), ++line_;
    if (!out.empty() && out.back() == '\r') out.remove_suffix(1);
    return out;
  }
  bool done() const { return rest_.empty(); }
  /// Empty at the end.
  std::string_view word() {
    while (!rest_.empty() && is_space(rest_.front())) {
      if (rest_.front() == '\n') ++line_;
      rest_.remove_prefix(1);
    }
    std::size_t n = 0;
    while (n < rest_.size() && !is_space(rest_[n])) ++n;
    const std::string_view out = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return out;
  }
  double number() {
    const std::string_view w = word();
    double v = 0;
    const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), v);
    if (error != std::errc{} || end != w.data() + w.size()) refuse(fmt::format("'{}' is not a number", w));
    return v;
  }
  std::string_view rest() const { return rest_; }
  /// How many words are left.
  std::size_t left() const {
    std::size_t out = 0;
    for (Words all = *this; !all.word().empty();) ++out;
    return out;
  }
  int at() const { return line_; }  ///< the line

 private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  std::string_view rest_;
  const std::string& path_;
  int line_ = 1;
};

}  // namespace weft::field
