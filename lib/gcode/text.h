// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/microns.h"

#include <charconv>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace weft::gcode {

/// A growing text with numbers as short as they can be, never of a locale. Lengths are whole microns and E is a whole
/// number of its last decimal, so that printing is integer arithmetic and exact.
class Text {
 public:
  explicit Text(std::size_t expected = 1024) { text_.resize(expected); }

  Text& operator<<(std::string_view s) {
    char* p = room(s.size());
    std::memcpy(p, s.data(), s.size());
    size_ += s.size();
    return *this;
  }
  Text& operator<<(char c) {
    *room(1) = c;
    ++size_;
    return *this;
  }
  Text& operator<<(std::int64_t v) {
    char* p = room(20);
    size_ += static_cast<std::size_t>(std::to_chars(p, p + 20, v).ptr - p);
    return *this;
  }

  /// A length in mm for moves: 12.5, .05, -3, 0.
  Text& length(Um v) { return decimal<3>(v); }
  /// A length in mm as JSON and the readers of comments want it: 12.5, 0.05, -3, 0.
  Text& spelled(Um v) { return decimal<3, true>(v); }
  /// A length of filament, in 10⁻⁵ mm, as mm.
  Text& filament(std::int64_t v) { return decimal<5>(v); }

  std::string take() && {
    text_.resize(size_);
    return std::move(text_);
  }

 private:
  char* room(std::size_t wanted) {
    if (size_ + wanted > text_.size()) text_.resize(2 * text_.size() + wanted);
    return text_.data() + size_;
  }

  /// v / 10^digits without the zeros that say nothing.
  template <int digits, bool leading_zero = false>
  Text& decimal(std::int64_t v) {
    constexpr std::uint64_t unit = digits == 3 ? 1000 : 100000;
    char* const begin = room(28);
    char* p = begin;
    if (v < 0) *p++ = '-';
    const std::uint64_t u = v < 0 ? 0 - static_cast<std::uint64_t>(v) : static_cast<std::uint64_t>(v);
    const std::uint64_t whole = u / unit;
    auto rest = static_cast<std::uint32_t>(u % unit);
    if (leading_zero || whole != 0 || rest == 0) p = std::to_chars(p, p + 20, whole).ptr;
    if (rest != 0) {
      *p++ = '.';
      for (int i = digits - 1; i >= 0; --i) p[i] = static_cast<char>('0' + rest % 10), rest /= 10;
      p += digits;
      while (p[-1] == '0') --p;
    }
    size_ += static_cast<std::size_t>(p - begin);
    return *this;
  }

  std::string text_;
  std::size_t size_ = 0;
};

}  // namespace weft::gcode
