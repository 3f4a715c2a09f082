// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <tuple>
#include <type_traits>

/// One list of the fields of a type, beside the type: whatever walks over fields (bytes of a cache, its memory, the
/// hash of a key, equality) is made from it, and a field that is not in the list does not compile.
///
///   struct SetFan { double share = 0; };
///   template <>
///   inline constexpr auto fields<SetFan> = listed(&SetFan::share);
namespace weft {

namespace detail {
struct Anything {
  template <class T>
  operator T() const;
};
}  // namespace detail

/// Number of fields of an aggregate: how many initialisers its braces take.
template <class T, class... Initialisers>
consteval std::size_t field_count() {
  if constexpr (requires { T{Initialisers{}..., detail::Anything{}}; })
    return field_count<T, Initialisers..., detail::Anything>();
  else
    return sizeof...(Initialisers);
}

/// The fields of T as pointers to members, in the order of their declaration.
template <class T>
inline constexpr int fields = 0;

/// Pre: every field of T is there once, in order: a struct with a field more, or fewer, is refused.
template <class T, class... Fields>
consteval auto listed(Fields T::*... members) {
  static_assert(sizeof...(Fields) == field_count<T>(), "a field is not in the list");
  return std::tuple{members...};
}
/// Of a type without fields.
template <class T>
consteval auto listed() {
  static_assert(field_count<T>() == 0, "a field is not in the list");
  return std::tuple{};
}

template <class T>
concept HasFields = !std::is_same_v<std::remove_cvref_t<decltype(fields<std::remove_cv_t<T>>)>, int>;

/// f(field) for each field of v, in order.
template <class T, class F>
requires HasFields<T>
constexpr void for_each_field(T& v, F&& f) {
  std::apply([&](auto... member) { (f(v.*member), ...); }, fields<std::remove_cv_t<T>>);
}

/// Are all fields equal?
template <class T>
requires HasFields<T>
constexpr bool same_fields(const T& a, const T& b) {
  return std::apply([&](auto... member) { return ((a.*member == b.*member) && ...); }, fields<T>);
}

}  // namespace weft
