// SPDX-License-Identifier: GPL-3.0-or-later
#include "body.h"

#include <algorithm>
#include <random>
#include <utility>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

namespace {

/// How high the highest rod is: what stands alone and is nowhere as wide as three beads.
Um highest_rod(const support::Plan& plan) {
  constexpr Um thin = 1200;
  Um most = 0;
  std::vector<std::pair<Box, Um>> rods;
  for (const auto& level : plan.layers) {
    std::vector<std::pair<Box, Um>> here;
    for (const Region& region : all_of(level)) {
      const Box box = box_of(region.outer);
      if (std::max(box.size().x, box.size().y) >= thin) continue;
      Um begun = level.z - level.height;
      for (const auto& [below, z] : rods)
        if (below.overlaps(box)) begun = std::min(begun, z);
      here.push_back({box, begun});
      most = std::max(most, level.z - begun);
    }
    rods = std::move(here);
  }
  return most;
}

}  // namespace

TEST_CASE("support: what no branch gets to hangs on to one nearby, and no rod stands under it") {
  std::mt19937 random(7);  // any
  const auto between = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
  };
  for (int n = 0; n < 20; ++n) {
    Body body;  // treads up a mast
    const Region mast = rectangle(-2000, -2000, 2000, 2000);
    body.add(100, {mast});
    for (int tread = 0; tread < 4; ++tread) {
      const Um x = between(-15000, 3000), y = between(-15000, 3000);
      const Um w = between(500, 6000), h = between(500, 6000), grows = between(200, 900);
      for (int step = 0; step < 8; ++step)  // its underside is a slope
        body.add(1, geometry::unite({mast, rectangle(x - step * grows, y - step * grows, x + w + step * grows,
                                                     y + h + step * grows)}));
      body.add(between(5, 20), {mast});
    }
    INFO("body " << n);
    CHECK(highest_rod(planned(on(SupportStructure::tree), body)) < 12000);
  }
}
