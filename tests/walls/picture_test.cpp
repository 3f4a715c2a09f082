// SPDX-License-Identifier: GPL-3.0-or-later
// What a failed geometry test leaves behind (tests/picture.h).
#include "picture.h"

#include "rectangle.h"
#include "shapes.h"

#include <catch2/catch.hpp>

using namespace weft;

TEST_CASE("pictures: a test's region is an outline, its beads are lines as wide as they are", "[walls]") {
  const WallLayer walls = test::built({test::rectangle(0, 0, 10'000, 5'000)});
  REQUIRE_FALSE(walls.beads.empty());
  const std::string svg = tests::picture_svg();
  CHECK(svg.starts_with("<svg"));
  CHECK(svg.find("viewBox='-0.5 -5.5 11 6'") != std::string::npos);
  CHECK(svg.find("class='outline' d='M 0,0 10,0 10,-5 0,-5 Z'") != std::string::npos);
  const double width = to_mm(walls.beads.front().path.front().width);
  CHECK(svg.find("stroke-width='" + std::to_string(width).substr(0, 5)) != std::string::npos);
  tests::new_picture();
  CHECK(tests::picture_svg().empty());
}
