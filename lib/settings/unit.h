// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstdint>
#include <string_view>

namespace weft {

/// The unit of a setting's number, as profiles may write it behind the number: `0.2`, `0.2 mm`, `20 %`.
enum class Unit : std::uint8_t {
  none,
  mm,
  mm_s,
  mm_s2,
  mm3_s,
  mm3_s2,
  degrees,
  celsius,
  percent,
  seconds,
  layers,
  g_cm3,
  per_kg,
  per_h,
  mm2,
  mm3,
  celsius_s
};

struct UnitName {
  Unit unit;
  std::string_view symbol;
};
inline constexpr std::array unit_names{
    UnitName{Unit::none, ""},       UnitName{Unit::mm, "mm"},          UnitName{Unit::mm_s, "mm/s"},
    UnitName{Unit::mm_s2, "mm/s²"}, UnitName{Unit::mm3_s, "mm³/s"},    UnitName{Unit::mm3_s2, "mm³/s²"},
    UnitName{Unit::degrees, "°"},   UnitName{Unit::celsius, "°C"},     UnitName{Unit::percent, "%"},
    UnitName{Unit::seconds, "s"},   UnitName{Unit::layers, "layers"},  UnitName{Unit::g_cm3, "g/cm³"},
    UnitName{Unit::per_kg, "/kg"},  UnitName{Unit::per_h, "/h"},       UnitName{Unit::mm2, "mm²"},
    UnitName{Unit::mm3, "mm³"},     UnitName{Unit::celsius_s, "°C/s"},
};
static_assert(
    [] {
      for (std::size_t i = 0; i < unit_names.size(); ++i)
        if (unit_names[i].unit != static_cast<Unit>(i)) return false;
      return true;
    }(),
    "row i of unit_names is unit i");
constexpr std::string_view symbol_of(Unit unit) {
  return unit_names[static_cast<std::size_t>(unit)].symbol;
}

}  // namespace weft
