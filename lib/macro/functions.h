// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "macro/value.h"

#include <cstddef>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>

/// The functions of the language that need nothing but their arguments' values.
namespace weft::macro {

/// How a function is called: its arguments at least and at most.
struct Signature {
  std::string_view name;
  std::size_t least, most;
};

/// Every function, those that the evaluator itself does included.
std::span<const Signature> signatures();

/// What an argument may be.
struct Argument {
  std::vector<Scalar> values;  ///< one unless it is a list
  bool list = false, regex = false;
};

/// @throws std::invalid_argument with one clause: wrong type, or out of range
Scalar call(std::string_view name, const std::vector<Argument>& arguments, std::uint64_t& random);

/// Does the whole text match? A '.' matches line ends too, as in PrusaSlicer.
/// @throws std::invalid_argument when the pattern is not one
bool matches(const std::string& text, const std::string& pattern);

/// @throws std::invalid_argument when it is none
double number_of(const Scalar& value);

}  // namespace weft::macro
