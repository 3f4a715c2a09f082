// SPDX-License-Identifier: GPL-3.0-or-later
#include "walls/skeleton.h"

#include <algorithm>
#include <limits>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::walls;

TEST_CASE("skeleton: around a corner ribs are so near that beads bend evenly, and no nearer") {
  constexpr double chord = 4, reach = 1'000;  // µm
  // The corner points into a part that is 30 mm thick there.
  const Region region{{{0, 0}, {60'000, 0}, {60'000, 30'000}, {30'000, 30'000}, {30'000, 60'000}, {0, 60'000}}, {}};
  const auto axis = geometry::medial_axis(region);
  REQUIRE(axis.valid);
  const auto around_corner = [&](const Skeleton& skeleton) {
    std::size_t ribs = 0;
    double off = 0;
    for (std::uint32_t h = 0; h < skeleton.halves.size(); ++h) {
      const Place foot = skeleton.halves[h].foot;
      if (distance(foot, skeleton.halves[skeleton.halves[h].next].foot) > 0) continue;
      ++ribs;
      const Place middle = lerp(skeleton.on_start_rib(h, reach), skeleton.on_end_rib(h, reach), 0.5);
      off = std::max(off, reach - distance(foot, middle));
    }
    return std::pair{ribs, off};
  };
  const auto [ribs, off] = around_corner(skeleton_of(axis, chord, reach));
  const auto [all, less_off] = around_corner(skeleton_of(axis, chord, std::numeric_limits<double>::infinity()));
  CHECK(off <= chord);
  CHECK(off > chord / 3);
  CHECK(less_off < off);
  CHECK(ribs >= 8);
  CHECK(2 * ribs < all);
}
