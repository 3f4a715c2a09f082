// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "macro/value.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

/// The macro language of PrusaSlicer's custom G-code: text with `[name]`, `{expression}`, `{if}{elsif}{else}{endif}`
/// and variables. Source: PrusaSlicer's published documentation ("Macros") and what PrusaSlicer 2.5 does when run;
/// local and global variables, is_nil, size, empty, one_of, interpolate_table, floor and ceil as documented for 2.6 and
/// later.
///
///   {1 + layer_num * 0.5}            numbers: whole and real; 7/2 is 3, 7/2.0 is 3.5; strings: "a" + 1 is a1
///   {a < b ? "yes" : "no"}           == != <> < > <= >=, and or not && || !, =~ /regex/ and !~ (the whole text
///   matches) {temperature[0]}, [temperature_0], [temperature], [temperature[initial_tool]] {if layer_num == 0}…{elsif
///   …}…{else}…{endif}, or {if … then x = 1; else x = 2; endif} {local x = 3}, {global y = (1, 2)}, {x = x + 1}, {y[0]
///   = 7}; statements are separated by ';' min max round floor ceil int digits zdigits random is_nil size empty one_of
///   interpolate_table regex_replace repeat
///
/// Beyond PrusaSlicer: a '[' that no name follows stands for itself; branches that are not taken are not evaluated, but
/// the names in them are checked.
namespace weft::macro {

struct Program;

/// What templates of one print share.
struct Scope {
  Variables globals;
  std::uint64_t random = 0;  ///< state of random(); the same seed gives the same numbers
  bool lenient = false;      ///< a trial with figures that are not the real ones: a division by zero gives 1
  std::size_t held = 0;      ///< bytes in globals, and in the variables of the template at hand
};

/// A text that has been read. Cheap to copy.
class Template {
 public:
  /// @param setting name of the setting that holds the text, for messages
  /// @throws Error{settings} with setting:line:column, for anything that is not of the language
  Template(std::string_view text, std::string_view setting);

  /// Every name has a value, every function exists and takes that many arguments, in branches not taken too.
  /// @param globals made by templates that are expanded earlier; those that this one makes are added
  /// @throws Error{settings} with setting:line:column and the nearest known name
  void check(const Variables& variables, Variables& globals) const;

  /// The text with everything in its place. Globals are kept in `scope`.
  /// @throws Error{settings} as check, and for what only shows with values: types, divisions by zero, indices, and more
  /// than a template may make (1 MB of text, 256 MB of values on the way) or variables may hold (16 MB)
  std::string expand(const Variables& variables, Scope& scope) const;

  /// Names of variables that the text mentions, in order.
  const std::vector<std::string>& names() const;

 private:
  std::shared_ptr<const Program> program_;
};

/// A condition alone, as in compatible_printers_condition; an empty one holds.
/// @throws Error{settings} as Template
bool holds(std::string_view condition, const Variables& variables, std::string_view where);

}  // namespace weft::macro
