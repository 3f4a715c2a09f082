// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/alike.h"

#include <algorithm>

#include <catch2/catch.hpp>

using namespace weft;

namespace {

/// A square with one corner that is moved, and a hole if asked for, whose first corner stands there.
Region region(Point at, Point corner = {1000, 1000}, bool hole = false, Um hole_at = 300) {
  Region out{{at, at + Point{1000, 0}, at + corner, at + Point{0, 1000}}, {}};
  const Point h = at + Point{hole_at, hole_at};
  if (hole) out.holes.push_back({h, h + Point{0, 200}, h + Point{200, 200}, h + Point{200, 0}});
  return out;
}

}  // namespace

TEST_CASE("core: regions are alike where they differ by their place alone", "[core]") {
  CHECK(first_alike({}).empty());
  CHECK(first_alike({region({0, 0})}) == std::vector<std::size_t>{0});
  Region turned = region({9000, 0});
  std::rotate(turned.outer.begin(), turned.outer.begin() + 1, turned.outer.end());
  const Regions regions{
      region({0, 0}),                                // 0
      region({2000, 0}, {1000, 1001}),               // 1: another corner
      region({4000, -7000}),                         // 2: as 0
      region({6000, 0}, {1000, 1000}, true),         // 3: a hole
      turned,                                        // 4: begins elsewhere
      region({-9000, 3}, {1000, 1001}),              // 5: as 1
      region({-3000, 9000}, {1000, 1000}, true),     // 6: as 3
      region({6000, 5000}, {1000, 1000}, true, 301)  // 7: the hole elsewhere
  };
  CHECK(first_alike(regions) == std::vector<std::size_t>{0, 1, 0, 3, 4, 1, 3, 7});
}
