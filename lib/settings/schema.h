// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/fields.h"
#include "settings/scope.h"
#include "settings/value.h"

#include <concepts>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

/// How a group of settings is declared: a plain struct holds types and defaults, a constexpr tuple of rows beside it
/// holds the rest. `settings/settings.h` lists the groups; everything that reads or writes settings walks these rows.
namespace weft {

/// One row. T is the field's type; Bound is what its range is measured in.
template <class Group, class T, class Bound>
struct Setting {
  using group_type = Group;
  using field_type = T;
  std::string_view key;
  Scope scope;  ///< where its value may differ
  T Group::*field;
  Unit unit;
  Bound least, most;  ///< inclusive; both zero: no range (text, choices, flags)
  std::string_view meaning;
};

namespace detail {
template <class T>
struct BoundOf {
  using type = T;
};
template <class T>
struct BoundOf<std::optional<T>> {
  using type = typename BoundOf<T>::type;
};
template <>
struct BoundOf<LengthOrShare> {
  using type = Um;
};
template <>
struct BoundOf<SpeedOrShare> {
  using type = double;
};
template <class T>
using Bound = typename BoundOf<T>::type;
struct NoBound {};
}  // namespace detail

/// A number with a unit and an inclusive range.
template <class Group, class T>
constexpr auto setting(std::string_view key, Scope scope, T Group::*field, Unit unit,
                       std::type_identity_t<detail::Bound<T>> least, std::type_identity_t<detail::Bound<T>> most,
                       std::string_view meaning) {
  return Setting<Group, T, detail::Bound<T>>{key, scope, field, unit, least, most, meaning};
}

/// A flag, a choice, a text or points.
template <class Group, class T>
constexpr auto setting(std::string_view key, Scope scope, T Group::*field, std::string_view meaning) {
  return Setting<Group, T, detail::NoBound>{key, scope, field, Unit::none, {}, {}, meaning};
}

/// Every field has a row: `static_assert(complete<WallSettings>(wall_schema))`.
template <class Group, class Schema>
consteval bool complete(const Schema&) {
  return field_count<Group>() == std::tuple_size_v<Schema>;
}

}  // namespace weft
