// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// std::visit with one overload a kind and no `auto` among them: a kind that nobody thought of is a compile error.
namespace weft {

template <class... F>
struct overloaded : F... {
  using F::operator()...;
};
template <class... F>
overloaded(F...) -> overloaded<F...>;

/// The kinds that a visitor has nothing to do with, named one by one.
template <class T>
struct LeavesOne {
  constexpr void operator()(const T&) const {}
};
template <class... T>
struct LeavesAlone : LeavesOne<T>... {
  using LeavesOne<T>::operator()...;
};

}  // namespace weft
