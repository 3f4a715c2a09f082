// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <charconv>
#include <concepts>
#include <optional>
#include <string_view>
#include <system_error>

namespace weft {

/// The number that the whole of a text is, written as C++ and G-code do whatever the language: no blanks, no `+`. Of
/// floating point `inf` and `nan` are numbers too. @return nothing: it is none, or none that T holds
template <class T>
std::optional<T> as_number(std::string_view text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

/// The same, of digits to a base from 2 to 36.
template <std::integral T>
std::optional<T> as_number(std::string_view text, int base) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace weft
