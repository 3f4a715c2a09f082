// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/parts.h"
#include "settings/value.h"

#include <string_view>

/// What parsers of values are made of. Private to settings.
namespace weft::value {

/// "'0.2abc' is not a length in mm". @throws std::invalid_argument
[[noreturn]] void refuse(std::string_view text, std::string_view what);

/// The number at the front of `text`, which is advanced past it and the white space behind it.
/// @throws std::invalid_argument, naming `whole`, where there is none
double take_number(std::string_view& text, std::string_view whole, std::string_view what);

/// Is `suffix` a way to write the unit? The plain-ASCII spellings of the symbols count too.
bool names_unit(std::string_view suffix, Unit unit);

/// @throws std::invalid_argument, naming `whole`, for what is no number of microns, or beyond 16 m
Um length_from(double mm, std::string_view whole);

/// f(part) for each part of the text, without white space around it.
template <class F>
void for_each_part(std::string_view text, char separator, F f) {
  for (const auto part : parts(text, separator)) f(trimmed(part));
}

}  // namespace weft::value
