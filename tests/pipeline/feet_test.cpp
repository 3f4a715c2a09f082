// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/feet.h"

#include "rectangle.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::test;

namespace {

constexpr pipeline::FeetStyle style{.foot = 1200, .apart = 5000};
const Regions everywhere{rectangle(-100000, -100000, 100000, 100000)};

/// A layer that lies on all of it.
const pipeline::LayerPlastic all_above(everywhere, {}, 400);

Bead bead_along(const Polyline& line, bool closed = false) {
  Bead out;
  out.role = Role::support, out.closed = closed;
  for (const Point p : line) out.path.push_back({p, 400, 1.F});
  return out;
}

}  // namespace

TEST_CASE(
    "feet: a line over the part is laid by pieces, at its ends and no further from each other than is asked for") {
  for (const Um length : {10000, 14321, 25000, 60000}) {
    const Beads feet = pipeline::on_feet({bead_along({{0, 0}, {length, 0}})}, everywhere, all_above, style);
    INFO(length);
    REQUIRE(feet.size() >= 3);
    CHECK(feet.front().path.front().at == Point{0, 0});
    CHECK(feet.back().path.back().at == Point{length, 0});
    for (std::size_t i = 0; i < feet.size(); ++i) {
      CHECK(length_mm(feet[i]) == Approx(1.2).margin(0.003));
      CHECK((feet[i].role == Role::support && feet[i].path.front().width == 400));
      if (i == 0) continue;
      const Um apart = feet[i].path.front().at.x - feet[i - 1].path.back().at.x;
      CHECK((apart >= style.foot - 3 && apart <= style.apart + 3));
    }
  }
}

TEST_CASE("feet: a loop stands on three at least, and goes round corners") {
  const Polyline square{{0, 0}, {4000, 0}, {4000, 4000}, {0, 4000}};
  const Beads feet = pipeline::on_feet({bead_along(square, true)}, everywhere, all_above, style);
  CHECK(feet.size() == 3);
  double mm = 0;
  for (const Bead& foot : feet) {
    CHECK_FALSE(foot.closed);
    mm += length_mm(foot);
  }
  CHECK(mm == Approx(3.6).margin(0.01));
  const Beads corner = pipeline::on_feet({bead_along({{0, 0}, {0, 600}, {12000, 600}})}, everywhere, all_above, style);
  CHECK(corner.front().path.size() == 3);
}

TEST_CASE("feet: what is too short for three, or lies on support, is laid whole") {
  const Bead little = bead_along({{0, 0}, {4500, 0}});
  CHECK(pipeline::on_feet({little}, everywhere, all_above, style) == Beads{little});
  const Bead ring = bead_along({{0, 0}, {1600, 0}, {1600, 1600}, {0, 1600}}, true);
  CHECK(pipeline::on_feet({ring}, everywhere, all_above, style) == Beads{ring});
  const Regions half{rectangle(20000, -1000, 100000, 1000)};
  const Beads feet = pipeline::on_feet({bead_along({{0, 0}, {40000, 0}})}, half, all_above, style);
  REQUIRE(feet.size() > 3);
  CHECK(length_mm(feet.front()) == Approx(21.2).margin(0.1));
}

TEST_CASE("feet: what beads above only lean on is laid whole, but where they cross no further than that") {
  const Bead line = bead_along({{0, 0}, {30000, 0}});
  const auto feet_under = [&](const Beads& above) {
    return pipeline::on_feet({line}, everywhere, pipeline::LayerPlastic({}, above, 400), style);
  };
  CHECK(feet_under({bead_along({{0, 420}, {30000, 420}}), bead_along({{0, -420}, {30000, -420}})}) == Beads{line});
  CHECK(feet_under({bead_along({{0, 100}, {30000, 100}})}).size() > 3);
  CHECK(feet_under({bead_along({{0, 700}, {30000, 700}})}).size() > 3);  // that lies on something else
  const Beads on_half = feet_under({bead_along({{0, 0}, {15000, 0}, {15000, 420}, {30000, 420}})});
  REQUIRE(on_half.size() > 2);
  CHECK(length_mm(on_half.back()) >= 14);
  const Beads across_a_gap = feet_under({bead_along({{0, 0}, {13000, 0}, {15000, 420}, {17000, 0}, {30000, 0}})});
  CHECK(across_a_gap.size() > 3);
  for (const Bead& foot : across_a_gap) CHECK(length_mm(foot) < 1.3);
}
