// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/fields.h"
#include "settings/scope.h"
#include "settings/value.h"

#include <concepts>
#include <cstddef>
#include <optional>
#include <string_view>
#include <type_traits>
#include <utility>

/// How a group of settings is declared: a plain struct holds types and defaults, a constexpr list of rows beside it
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
template <>
struct BoundOf<Numbers> {
  using type = double;
};
template <>
struct BoundOf<ValuesAt> {
  using type = double;
};
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

namespace detail {
template <std::size_t, class Row>
struct RowAt {
  Row row;
};
template <class Indices, class... Row>
struct RowsAt;
template <std::size_t... I, class... Row>
struct RowsAt<std::index_sequence<I...>, Row...> : RowAt<I, Row>... {
  constexpr explicit RowsAt(const Row&... row) : RowAt<I, Row>{row}... {}
  template <class See>
  constexpr void for_each(const See& see) const {
    (see(static_cast<const RowAt<I, Row>&>(*this).row), ...);
  }
};
template <class T, std::size_t... I>
consteval bool takes_initialisers(std::index_sequence<I...>) {
  return requires {
    T{(static_cast<void>(I), Anything{})...};
  };
}
}  // namespace detail

/// Rows of different types, in order; `for_each` calls a function with each of them. A std::tuple of hundreds asks
/// compilers for three seconds in every file that knows of settings, because its constructors are many; this has one.
template <class... Row>
struct Rows : detail::RowsAt<std::index_sequence_for<Row...>, Row...> {
  static constexpr std::size_t count = sizeof...(Row);
  using detail::RowsAt<std::index_sequence_for<Row...>, Row...>::RowsAt;
};
template <class... Row>
Rows(const Row&...) -> Rows<Row...>;

/// Has T that many fields? The same as field_count, without counting up to it.
template <class T, std::size_t count>
consteval bool has_fields() {
  return detail::takes_initialisers<T>(std::make_index_sequence<count>()) &&
         !detail::takes_initialisers<T>(std::make_index_sequence<count + 1>());
}

/// Every field has a row: `static_assert(complete<WallSettings>(wall_schema))`.
template <class Group, class Schema>
consteval bool complete(const Schema&) {
  return has_fields<Group, Schema::count>();
}

}  // namespace weft
