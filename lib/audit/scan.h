// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <cstdint>

/// Reading numbers and words from the bytes of a line, without locale, without allocation. Pre everywhere: *end may be
/// read and is a line feed, so that no digit loop needs to look where the line ends.
namespace weft::audit::scan {

inline constexpr double powers_of_ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8, 1e9,
                                           1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18};
inline constexpr int most_digits = 18;  // of a 64-bit mantissa

/// Lengths beyond this are no place of any machine: a number was damaged. Numbers that are no lengths along an axis
/// (E of a whole spool, F) must only be ones that can be reckoned with.
inline constexpr double furthest_mm = 1e5, largest_number = 1e9;

/// @param letter of the word, from A = 0
constexpr double limit_of(unsigned letter) {
  constexpr std::uint32_t lengths = 1U << ('X' - 'A') | 1U << ('Y' - 'A') | 1U << ('Z' - 'A') | 1U << ('I' - 'A') |
                                    1U << ('J' - 'A') | 1U << ('K' - 'A') | 1U << ('R' - 'A');
  return (lengths >> letter) & 1U ? furthest_mm : largest_number;
}

constexpr bool is_digit(char c) {
  return static_cast<unsigned char>(c - '0') < 10;
}
constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t';
}
constexpr char upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
constexpr bool is_letter(char c) {
  return static_cast<unsigned char>((c | 0x20) - 'a') < 26;
}

/// Digits that overflow the mantissa: leading zeros are no digits, and decimals behind the 18th are below any
/// tolerance.
inline const char* long_number(const char* p, double& out) {
  double v = 0, unit = 1;
  for (; is_digit(*p); ++p) v = v * 10 + (*p - '0');
  if (*p == '.')
    for (++p; is_digit(*p); ++p) v += (*p - '0') * (unit /= 10);
  out = v;
  return p;
}

/// A decimal number: sign, digits, point; at least one digit. Correctly rounded up to 15 digits.
/// @return behind it, or nullptr when there is none
inline const char* number(const char* p, double& out) {
  const bool negative = *p == '-';
  if (negative || *p == '+') ++p;
  const char* const begin = p;
  std::uint64_t mantissa = 0;
  for (; is_digit(*p); ++p) mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p - '0');
  auto digits = p - begin;
  std::ptrdiff_t decimals = 0;
  if (*p == '.') {
    const char* const point = p++;
    for (; is_digit(*p); ++p) mantissa = mantissa * 10 + static_cast<std::uint64_t>(*p - '0');
    decimals = p - point - 1;
    digits += decimals;
  }
  if (digits == 0) return nullptr;
  if (digits > most_digits)
    p = long_number(begin, out);
  else
    out = static_cast<double>(mantissa) / powers_of_ten[decimals];
  if (negative) out = -out;
  return p;
}

}  // namespace weft::audit::scan
