// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/text.h"

#include <charconv>
#include <limits>

namespace weft::mesh {
namespace {

bool ends_line(char c) {
  return c == '\n' || c == '\r';
}
bool blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}
char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace

std::string_view Words::take_word() {
  word_ = at_;
  while (at_ < text_.size() && !blank(text_[at_]) && !ends_line(text_[at_])) ++at_;
  return text_.substr(word_, at_ - word_);
}

std::string_view Words::next() {
  while (at_ < text_.size() && (blank(text_[at_]) || ends_line(text_[at_]))) ++at_;
  return take_word();
}

std::string_view Words::next_in_line() {
  while (at_ < text_.size() && blank(text_[at_])) ++at_;
  return take_word();
}

std::string_view Words::rest_of_line() {
  while (at_ < text_.size() && blank(text_[at_])) ++at_;
  const std::size_t from = at_;
  while (at_ < text_.size() && !ends_line(text_[at_])) ++at_;
  std::size_t to = at_;
  while (to > from && blank(text_[to - 1])) --to;
  if (at_ < text_.size()) at_ += text_.substr(at_).starts_with("\r\n") ? std::size_t{2} : std::size_t{1};
  return text_.substr(from, to - from);
}

std::size_t Words::line_of(std::size_t place) const {
  std::size_t line = 1;
  for (std::size_t i = 0; i < place; ++i)
    line += text_[i] == '\n' || (text_[i] == '\r' && (i + 1 >= text_.size() || text_[i + 1] != '\n'));
  return line;
}

bool same_word(std::string_view word, std::string_view lower_case) {
  if (word.size() != lower_case.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i)
    if (lower(word[i]) != lower_case[i]) return false;
  return true;
}

std::optional<double> number_in(std::string_view word) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error == std::errc::invalid_argument) return std::nullopt;
  if (error == std::errc::result_out_of_range) {
    const bool tiny = word.find("e-") != word.npos || word.find("E-") != word.npos || word.starts_with("0.") ||
                      word.starts_with("-0.");
    return tiny ? 0.0 : std::numeric_limits<double>::infinity();
  }
  return value;
}

}  // namespace weft::mesh
