// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace weft::macro {

/// PrusaSlicer's `nil`: an override that overrides nothing.
struct Nil {
  friend bool operator==(Nil, Nil) = default;
};

/// What an expression gives.
using Scalar = std::variant<Nil, bool, std::int64_t, double, std::string>;

/// As `{…}` writes it. Numbers have six significant digits as in PrusaSlicer; where that would need an exponent, which
/// no firmware reads, they are written out instead.
std::string text_of(const Scalar& value);

/// What a name in a template stands for.
struct Variable {
  std::vector<Scalar> values;  ///< one, or the elements of a list
  std::string text;       ///< what `[name]` writes where there is one value; empty: as `{…}` does, but flags 1, 0
  std::string missing;    ///< why there is no value ("is auto"); using it is then an error
  bool writable = false;  ///< a template may assign to it, for the rest of itself
};
using Variables = std::map<std::string, Variable, std::less<>>;

Variable variable(Scalar value);

/// A value in the words of an ini: elements separated by ','; one with a ',', blanks at its ends or '"' is quoted (with
/// \" and \\ inside). Elements that are whole numbers, numbers, true, false or nil are those; `20%` is 20, but `[name]`
/// writes it as it stood.
Variable variable_of(std::string_view ini_text);

/// The name in `names` nearest to a wrong one by edit distance, or empty when nothing is near.
std::string nearest_name(std::string_view wrong, const std::vector<std::string_view>& names);

}  // namespace weft::macro
