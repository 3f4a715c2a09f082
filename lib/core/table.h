// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstddef>

/// Tables with a row for each value of an enumeration.
namespace weft {

/// Is row i the row of value i? What a static_assert beside a table asks, so that a row is found by its index.
template <class Row, std::size_t count, class Value>
constexpr bool in_order(const std::array<Row, count>& rows, Value Row::*value) {
  for (std::size_t i = 0; i < count; ++i)
    if (rows[i].*value != static_cast<Value>(i)) return false;
  return true;
}

/// The row of a value. Pre: the table is in order and complete.
template <class Row, std::size_t count, class Value>
constexpr const Row& row_of(const std::array<Row, count>& rows, Value value) {
  return rows[static_cast<std::size_t>(value)];
}

}  // namespace weft
