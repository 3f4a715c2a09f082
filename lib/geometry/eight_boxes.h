// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "core/polygon.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

/// Private to geometry/.
namespace weft::geometry {

/// Up to eight boxes, all of which are asked at once.
class alignas(16) EightBoxes {
 public:
  static constexpr std::uint32_t count = 8;

  EightBoxes() {
    min_x_.fill(nowhere), min_y_.fill(nowhere);
    max_x_.fill(-nowhere), max_y_.fill(-nowhere);
  }
  /// Of eight edges that follow each other, by where their ends are.
  EightBoxes(const std::array<Um, count + 1>& x, const std::array<Um, count + 1>& y) {
    for (std::size_t k = 0; k < count; ++k) {
      min_x_[k] = std::min(x[k], x[k + 1]), max_x_[k] = std::max(x[k], x[k + 1]);
      min_y_[k] = std::min(y[k], y[k + 1]), max_y_[k] = std::max(y[k], y[k + 1]);
    }
  }
  /// The first ones only.
  void keep(std::size_t first) {
    for (std::size_t k = first; k < count; ++k) min_x_[k] = nowhere;
  }
  void set(std::size_t k, const Box& box) {
    min_x_[k] = box.min.x, min_y_[k] = box.min.y, max_x_[k] = box.max.x, max_y_[k] = box.max.y;
  }
  Box operator[](std::size_t k) const { return {{min_x_[k], min_y_[k]}, {max_x_[k], max_y_[k]}}; }

  /// Bit k: box k was set and has a point in common with that one.
  std::uint32_t meeting(const Box& box) const {
#if defined(__SSE2__)
    const auto load = [](const Um* four) { return _mm_load_si128(reinterpret_cast<const __m128i*>(four)); };
    const __m128i low_x = _mm_set1_epi32(box.min.x), low_y = _mm_set1_epi32(box.min.y);
    const __m128i high_x = _mm_set1_epi32(box.max.x), high_y = _mm_set1_epi32(box.max.y);
    const auto apart = [&](std::size_t k) {
      const __m128i x =
          _mm_or_si128(_mm_cmpgt_epi32(load(&min_x_[k]), high_x), _mm_cmpgt_epi32(low_x, load(&max_x_[k])));
      const __m128i y =
          _mm_or_si128(_mm_cmpgt_epi32(load(&min_y_[k]), high_y), _mm_cmpgt_epi32(low_y, load(&max_y_[k])));
      return static_cast<std::uint32_t>(_mm_movemask_ps(_mm_castsi128_ps(_mm_or_si128(x, y))));
    };
    return (apart(0) | apart(4) << 4) ^ 0xff;
#else
    return meeting_one_by_one(box);
#endif
  }
  /// The same where eight cannot be asked at once.
  std::uint32_t meeting_one_by_one(const Box& box) const {
    std::uint32_t out = 0;
    for (std::uint32_t k = 0; k < count; ++k) out |= std::uint32_t{(*this)[k].overlaps(box)} << k;
    return out;
  }

 private:
  static constexpr Um nowhere = 2 * max_coord;
  std::array<Um, count> min_x_, min_y_, max_x_, max_y_;
};

/// Calls f(k) for each bit k that is set, k rising.
template <class F>
void for_each_bit(std::uint32_t bits, F&& f) {
  for (; bits != 0; bits &= bits - 1) f(static_cast<std::uint32_t>(std::countr_zero(bits)));
}

}  // namespace weft::geometry
