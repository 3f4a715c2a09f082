// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>

namespace weft {

/// A length or coordinate in whole microns: the only length unit on an interface. |value| <= max_coord.
using Um = std::int32_t;

/// 16.8 m. With coordinates below it every cross product of differences is exact in int64, and in double.
inline constexpr Um max_coord = 1 << 24;

inline namespace literals {
/// `0.45_mm` is 450.
consteval Um operator""_mm(long double mm) {
  return static_cast<Um>(mm * 1000.0L + (mm < 0 ? -0.5L : 0.5L));
}
consteval Um operator""_mm(unsigned long long mm) {
  return static_cast<Um>(mm * 1000);
}
consteval Um operator""_um(unsigned long long um) {
  return static_cast<Um>(um);
}
}  // namespace literals

/// Millimetres of a length, for formulas and for printing.
constexpr double to_mm(Um length) {
  return length / 1000.0;
}

/// The nearest micron of a length in fractional microns; ties away from zero, as std::lround, which is a call and took
/// 2 % of all instructions. Pre: |um| < 2^31.
constexpr Um rounded(double um) {
  const auto whole = static_cast<std::int64_t>(um);
  const double rest = um - static_cast<double>(whole);  // exact
  return static_cast<Um>(whole + (rest >= 0.5 ? 1 : 0) - (rest <= -0.5 ? 1 : 0));
}

/// The nearest micron; ties away from zero. Pre: |mm| <= 16 000.
constexpr Um from_mm(double mm) {
  return rounded(mm * 1000.0);
}

}  // namespace weft
