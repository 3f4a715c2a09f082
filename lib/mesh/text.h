// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

/// Reading words and numbers of a text format, whatever the locale and whatever ends its lines: LF, CRLF or CR.
namespace weft::mesh {

/// Walks over a text. Never copies.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  /// The next word, past blanks and line ends; empty at the end of the text.
  std::string_view next();

  /// The next word of this line; empty at its end.
  std::string_view next_in_line();

  /// What is left of this line, without blanks around it; goes to the next line.
  std::string_view rest_of_line();

  bool at_end() const { return at_ >= text_.size(); }

  /// Where the last word begins.
  std::size_t place() const { return word_; }

  /// The line of a place, from 1. Cost: counts from the start of the text, so for messages only.
  std::size_t line_of(std::size_t place) const;

 private:
  std::string_view take_word();

  std::string_view text_;
  std::size_t at_ = 0, word_ = 0;
};

/// Whether `word` is `lower_case` but for its case.
bool same_word(std::string_view word, std::string_view lower_case);

/// The number that `word` is as a whole: "1", "-.5", "+1e-3"; NaN and infinity as values; too small for a double is 0,
/// too large is infinite. Nothing when it is no number.
std::optional<double> number_in(std::string_view word);

}  // namespace weft::mesh
