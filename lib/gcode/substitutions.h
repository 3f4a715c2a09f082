// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace weft::gcode {

/// What the setting `gcode_substitutions` asks for, ready to be done: one after the other, each wherever it finds
/// something. Lines of it are `s/FIND/REPLACE/FLAGS`; the character behind the s stands for the slash, and `\` before
/// it means the character itself. Without the flag r both are plain texts, in which `\n`, `\t` and `\\` are what they
/// are in C; with it FIND is a regular expression of Perl's and REPLACE may say `$1`, `${name}`, `\n`. Flags: i, of
/// either case; w, whole words only; s, in one piece: a dot is also the end of a line. `^` and `$` are those of a line.
/// Source: PCRE2's pages pcre2pattern and pcre2api (what does the work).
class Substitutions {
 public:
  /// @throws Error{settings} naming the setting and its line: what is wrong with it, and where
  explicit Substitutions(std::string_view setting);
  ~Substitutions();
  Substitutions(const Substitutions&) = delete;
  Substitutions& operator=(const Substitutions&) = delete;

  bool empty() const { return all_.empty(); }

  /// The text with all of them done. May be called from many threads. Cost: without any, nothing.
  /// @throws Error{settings} naming the line of one that takes too long to look for, or makes more of the text than
  ///         memory is for
  std::string done(std::string text) const;

 private:
  struct One;
  std::vector<One> all_;
};

}  // namespace weft::gcode
