// SPDX-License-Identifier: GPL-3.0-or-later
#include "slice/interlock.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::literals;
using weft::slice::interlocked;
using weft::slice::InterlockStyle;

namespace {

Regions rectangle(Um x0, Um y0, Um x1, Um y1) {
  return {{{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}}};
}
const Regions left = rectangle(0, 0, 20_mm, 20_mm), right = rectangle(20_mm, 0, 40_mm, 20_mm),
              anywhere = rectangle(-1_mm, -1_mm, 41_mm, 21_mm);

}  // namespace

TEST_CASE("interlock: beams lie around the face where parts touch, half of them of each") {
  const InterlockStyle style;
  const auto [a, b] = interlocked(style, 0, left, right, anywhere);
  const Um reach = style.depth * style.beam_width + 50;  // touching
  const Regions zone = rectangle(20_mm - reach, 0, 20_mm + reach, 20_mm);
  CHECK(geometry::subtract(a, geometry::offset(zone, {.by = 5})).empty());
  CHECK(geometry::subtract(b, geometry::offset(zone, {.by = 5})).empty());
  CHECK(geometry::intersect(a, b).empty());
  CHECK(area_mm2(a) + area_mm2(b) == Approx(area_mm2(zone)).epsilon(0.02));
  CHECK(area_mm2(a) == Approx(area_mm2(b)).epsilon(0.15));
  CHECK(area_mm2(geometry::intersect(a, right)) > 0.3 * area_mm2(a));  // they reach into the other
}

TEST_CASE("interlock: beams cross those of the next set of layers, and every set is like the last but one") {
  const InterlockStyle style;
  const auto first = interlocked(style, 0, left, right, anywhere), same = interlocked(style, 1, left, right, anywhere),
             across = interlocked(style, 2, left, right, anywhere),
             again = interlocked(style, 4, left, right, anywhere);
  CHECK(first.to_a == same.to_a);
  CHECK(first.to_a == again.to_a);
  const double common = area_mm2(geometry::intersect(first.to_a, across.to_a));
  CHECK(common == Approx(area_mm2(first.to_a) / 2).epsilon(0.2));
}

TEST_CASE("interlock: what does not touch, or may not, is left as it is") {
  const InterlockStyle style;
  const auto apart = interlocked(style, 0, left, rectangle(20200, 0, 40_mm, 20_mm), anywhere);
  CHECK(apart.to_a.empty());
  CHECK(apart.to_b.empty());
  const auto nowhere = interlocked(style, 0, left, right, {});
  CHECK(nowhere.to_a.empty());
  const Regions middle = rectangle(15_mm, 5_mm, 25_mm, 15_mm);
  const auto within = interlocked(style, 0, left, right, middle);
  CHECK(geometry::subtract(within.to_a, geometry::offset(middle, {.by = 5})).empty());
  CHECK_FALSE(within.to_a.empty());
}
