// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/core_fields.h"
#include "settings/settings.h"

#include <bit>
#include <string>
#include <string_view>

/// Settings as bytes without loss: what keys of cached results are made of. Text is for readers and rounds to six
/// decimals; two settings that print alike may slice differently.
namespace weft {

template <>
inline constexpr auto fields<LengthOrShare> = listed(&LengthOrShare::length, &LengthOrShare::percent,
                                                     &LengthOrShare::is_share);
template <>
inline constexpr auto fields<SpeedOrShare> = listed(&SpeedOrShare::value, &SpeedOrShare::is_share);
template <>
inline constexpr auto fields<PictureSize> = listed(&PictureSize::width, &PictureSize::height);
template <>
inline constexpr auto fields<ValueAt> = listed(&ValueAt::at, &ValueAt::value);
template <>
inline constexpr auto fields<TransferCurve> = listed(&TransferCurve::kind, &TransferCurve::first,
                                                     &TransferCurve::second);
template <>
inline constexpr auto fields<Rgb> = listed(&Rgb::r, &Rgb::g, &Rgb::b);
template <>
inline constexpr auto fields<HeightMark> = listed(&HeightMark::z, &HeightMark::text);
template <>
inline constexpr auto fields<HeightBand> = listed(&HeightBand::from, &HeightBand::to, &HeightBand::height);
template <>
inline constexpr auto fields<PressureRow> = listed(&PressureRow::advance_s, &PressureRow::mm3_s, &PressureRow::mm_s2,
                                                   &PressureRow::height);
template <>
inline constexpr auto fields<ToolValue> = listed(&ToolValue::tool, &ToolValue::key, &ToolValue::text);

}  // namespace weft

namespace weft::exact {

inline void add(std::string& to, std::uint64_t v) {
  for (int i = 0; i < 8; ++i) to += static_cast<char>(v >> (8 * i));
}
inline void add(std::string& to, Um v) {
  add(to, static_cast<std::uint64_t>(static_cast<std::int64_t>(v)));
}
inline void add(std::string& to, std::uint8_t v) {
  to += static_cast<char>(v);
}
inline void add(std::string& to, bool v) {
  to += v ? '\1' : '\0';
}
inline void add(std::string& to, double v) {
  add(to, std::bit_cast<std::uint64_t>(v));
}
inline void add(std::string& to, std::string_view v) {
  add(to, std::uint64_t{v.size()}), to += v;
}
inline void add(std::string& to, const std::string& v) {
  add(to, std::string_view(v));
}
template <class E>
requires std::is_enum_v<E>
void add(std::string& to, E v) {
  add(to, static_cast<std::uint64_t>(v));
}
template <class T>
void add(std::string& to, const std::optional<T>& v);
template <class T>
requires HasFields<T>
void add(std::string& to, const T& v) {
  for_each_field(v, [&](const auto& field) { add(to, field); });
}
template <class T>
void add(std::string& to, const std::vector<T>& v) {
  add(to, std::uint64_t{v.size()});
  for (const auto& item : v) add(to, item);
}
template <class T>
void add(std::string& to, const std::optional<T>& v) {
  add(to, v.has_value());
  if (v) add(to, *v);
}

/// A function of its own for each type: three hundred rows in one take compilers a minute.
template <class T>
void add_row(std::string& to, std::string_view key, const T& value) {
  add(to, key), add(to, value);
}

/// Every field of a group, each behind its key. Pre: `rows` is the group's schema.
template <class Group, class Schema>
void add_group(std::string& to, const Group& group, const Schema& rows) {
  rows.for_each([&](const auto& row) { add_row(to, row.key, group.*(row.field)); });
}

/// Every setting.
inline std::string bytes_of(const Settings& settings) {
  std::string out;
  sections.for_each([&](const auto& section) { add_group(out, settings.*(section.group), section.rows); });
  return out;
}

}  // namespace weft::exact
