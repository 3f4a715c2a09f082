// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/trapped.h"

#include "body.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

namespace {

/// A box with a floor and a lid, and a door of that width in one wall.
Body box_with_door(Um door) {
  Body out;
  out.add(10, {rectangle(-15000, -15000, 15000, 15000)});
  Regions walls =
      geometry::subtract({rectangle(-15000, -15000, 15000, 15000)}, {rectangle(-12000, -12000, 12000, 12000)});
  if (door > 0) walls = geometry::subtract(walls, {rectangle(-door / 2, 0, door / 2, 16000)});
  out.add(50, walls);
  out.add(15, {rectangle(-15000, -15000, 15000, 15000)});
  return out;
}

}  // namespace

TEST_CASE("support: what is in a box without a door wide enough is trapped, and told") {
  for (const Um door : {0, 1000, 8000}) {
    auto body = box_with_door(door);
    auto s = on();
    s.support_bridges = true;
    const auto plan = planned(s, body);
    INFO(door);
    REQUIRE_FALSE(plan.layers.empty());
    if (door == 8000) {
      CHECK(plan.trapped.empty());
      continue;
    }
    REQUIRE(plan.trapped.size() == plan.layers.size());
    for (std::size_t k = 0; k < plan.layers.size(); ++k)
      if (!all_of(plan.layers[k]).empty()) CHECK(plan.trapped[k] > 0.9);
  }
}

TEST_CASE("support: what stands on the bed under a table is not trapped") {
  auto body = tee();
  CHECK(planned(on(), body).trapped.empty());
}
