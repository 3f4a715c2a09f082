// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/offset.h"

#include "geometry/boolean.h"
#include "picture.h"
#include "shapes.h"

#include <algorithm>
#include <complex>
#include <numbers>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::geometry;
using shapes::rectangle;

namespace {
double farthest(const Ring& from, Point centre) {
  double most = 0;
  for (const Point p : from) most = std::max(most, distance(p, centre));
  return most;
}
}  // namespace

TEST_CASE("geometry: a triangle offset inwards has its corners where the bisectors put them") {
  const Regions inner = offset({{{{0, 0}, {4000, 0}, {2000, 3000}}, {}}}, {.by = -500});
  REQUIRE(inner.size() == 1);
  for (const Point expected : {Point{934, 500}, Point{3066, 500}, Point{2000, 2099}})
    CHECK(
        std::any_of(inner[0].outer.begin(), inner[0].outer.end(), [&](Point p) { return distance(p, expected) <= 2; }));
  CHECK(inner[0].outer.size() == 3);
  CHECK(inner[0].holes.empty());
}

TEST_CASE("geometry: a square grown with round corners has the area of a rounded square") {
  const Regions grown =
      offset({rectangle({0, 0}, {10000, 10000})}, {.by = 2000, .corner = Corner::round, .arc_tolerance = 2});
  CHECK(area_mm2(grown) == Approx(100 + 4 * 10 * 2 + std::numbers::pi * 4).epsilon(0.001));
}

TEST_CASE("geometry: corners grow as their name says") {
  const Regions square{rectangle({0, 0}, {10000, 10000})};
  CHECK(area_mm2(offset(square, {.by = 1000})) == Approx(144.0));
  CHECK(area_mm2(offset(square, {.by = 1000, .corner = Corner::bevel})) == Approx(144.0 - 4 * 0.5));
}

TEST_CASE("geometry: a miter beyond its limit is cut square at the offset distance") {
  const Regions needle{{{{0, -500}, {20000, 0}, {0, 500}}, {}}};
  const auto right_end = [&](double limit) { return box_of(offset(needle, {.by = 1000, .miter_limit = limit})).max.x; };
  CHECK(right_end(2) == Approx(21000).margin(2));
  CHECK(right_end(100) == Approx(20000 + 1000 * 40.0125).margin(40));  // 1000 / sin(atan(0.025))
}

TEST_CASE("geometry: a spike that turns back on itself is no trouble") {
  const Regions spiked{{{{0, 0}, {10000, 0}, {20000, 0}, {10000, 0}, {10000, 10000}, {0, 10000}}, {}}};
  CHECK(area_mm2(offset(spiked, {.by = -1000})) == Approx(64.0));
}

TEST_CASE("geometry: a convex shape offset out and in returns", "[law]") {
  const Corner corner = GENERATE(Corner::miter, Corner::round);
  shapes::Dice dice(7);
  for (int i = 0; i < 50; ++i) {
    const Regions shape{{shapes::convex(dice, {dice.between(-50000, 50000), 0}, 10000, dice.between(3, 40)), {}}};
    tests::look_at(shape);
    const Regions back = offset(offset(shape, {.by = 700, .corner = corner}), {.by = -700, .corner = corner});
    const double perimeter_mm = perimeter_of(shape[0].outer) / 1000;
    CHECK(area_mm2(exclusive_or(shape, back)) < perimeter_mm * 0.001);
  }
}

TEST_CASE("geometry: holes shrink when a part grows, and vanish when they are narrow enough") {
  Region frame = rectangle({0, 0}, {20000, 20000});
  frame.holes.push_back(shapes::reversed(rectangle({5000, 5000}, {9000, 9000}).outer));
  frame.holes.push_back(shapes::reversed(rectangle({12000, 12000}, {13000, 13000}).outer));
  const Regions grown = offset({frame}, {.by = 600});
  REQUIRE(grown.size() == 1);
  REQUIRE(grown[0].holes.size() == 1);
  CHECK(double_area(grown[0].outer) > 0);
  CHECK(double_area(grown[0].holes[0]) == -2LL * 2800 * 2800);
  const Regions shrunk = offset({frame}, {.by = -600});
  REQUIRE(shrunk.size() == 1);
  CHECK(area_mm2(shrunk) == Approx(18.8 * 18.8 - 5.2 * 5.2 - 2.2 * 2.2));
}

TEST_CASE("geometry: parts that meet when grown become one, a part too thin when shrunk is gone, a waist parts") {
  const Regions two{rectangle({0, 0}, {1000, 1000}), rectangle({1500, 0}, {2500, 1000})};
  CHECK(offset(two, {.by = 300}).size() == 1);
  CHECK(offset(two, {.by = 200}).size() == 2);
  CHECK(offset(two, {.by = -500}).empty());
  const Regions dumbbell = unite(
      {rectangle({0, 0}, {5000, 5000}), rectangle({4000, 2300}, {9000, 2700}), rectangle({8000, 0}, {13000, 5000})});
  REQUIRE(dumbbell.size() == 1);
  CHECK(offset(dumbbell, {.by = -250}).size() == 2);
}

TEST_CASE("geometry: a grown region keeps its distance and no more, on seeded stars", "[law]") {
  shapes::Dice dice(11);
  for (int i = 0; i < 40; ++i) {
    const Regions shape{{shapes::star(dice, {0, 0}, 8000, dice.between(3, 60)), {}}};
    tests::look_at(shape);
    const Um by = dice.between(50, 3000);
    const Regions grown = offset(shape, {.by = by, .corner = Corner::round});
    REQUIRE(grown.size() == 1);
    CHECK(area_mm2(subtract(shape, grown)) == 0);
    CHECK(farthest(grown[0].outer, {0, 0}) <= farthest(shape[0].outer, {0, 0}) + by + 6);
    // The distance of each new corner from the old outline is `by`.
    for (const Point p : grown[0].outer) {
      double nearest = 1e9;
      const Ring& r = shape[0].outer;
      for (std::size_t k = 0; k < r.size(); ++k) {
        const Point a = r[k], b = r[(k + 1) % r.size()];
        const double t =
            std::clamp(static_cast<double>(dot(p - a, b - a)) / static_cast<double>(dot(b - a, b - a)), 0.0, 1.0);
        nearest = std::min(nearest, std::hypot(a.x + t * (b.x - a.x) - p.x, a.y + t * (b.y - a.y) - p.y));
      }
      CHECK(nearest >= by - 6);
      CHECK(nearest <= by + 6);
    }
  }
}

namespace {
/// What edges sweep over as they move, and what fills the gaps between them.
Regions swept(const Regions& regions, const OffsetOptions& options) {
  using Vector = std::complex<double>;
  std::vector<Ring> rings;
  const auto add = [&](Point from, const std::vector<Vector>& others) {
    Ring ring{from};
    for (const Vector v : others) ring.push_back(from + Point{rounded(v.real()), rounded(v.imag())});
    if (double_area(ring) < 0) std::reverse(ring.begin(), ring.end());
    if (double_area(ring) > 0) rings.push_back(std::move(ring));
  };
  const double by = options.by;
  for (const Ring& ring : rings_of(regions))
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point a = ring[i == 0 ? ring.size() - 1 : i - 1], b = ring[i], c = ring[i + 1 < ring.size() ? i + 1 : 0];
      const Vector in(b.x - a.x, b.y - a.y), on(c.x - b.x, c.y - b.y);
      const Vector before = in / std::abs(in), after = on / std::abs(on), out{0, -by};
      add(b, {on, on + out * after, out * after});
      const double turn_rad = std::arg(on / in);
      if (turn_rad * by <= 0) continue;
      std::vector<Vector> fan;
      if (options.corner == Corner::round)
        for (int k = 0; k <= 64; ++k) fan.push_back(out * before * std::polar(1.0, turn_rad * k / 64));
      else if (1 / std::cos(turn_rad / 2) <= options.miter_limit)
        fan = {out * before, out * before + std::abs(by * std::tan(turn_rad / 2)) * before, out * after};
      else
        fan = {out * before, out * before + std::abs(by * std::tan(turn_rad / 4)) * before,
               out * after - std::abs(by * std::tan(turn_rad / 4)) * after, out * after};
      add(b, fan);
    }
  return regions_from_rings(rings, WindingRule::nonzero);
}
}  // namespace

TEST_CASE("geometry: an offset is what edges sweep over, however short they are", "[law]") {
  const auto seed = static_cast<std::uint32_t>(GENERATE(range(0, 60)));
  CAPTURE(seed);
  shapes::Dice dice(seed);
  Regions shape;
  for (int i = dice.between(1, 6); i > 0; --i) {
    const Point at{dice.between(-4000, 4000), dice.between(-4000, 4000)};
    const int corners = dice.between(3, 120);
    shape.push_back({dice.share() < 0.5 ? shapes::star(dice, at, dice.between(500, 4000), corners)
                                        : shapes::convex(dice, at, dice.between(500, 4000), corners),
                     {}});
  }
  shape = unite(shape);
  const Um by = dice.between(5, 1500);
  const auto wide_part_beyond = [](const Regions& some, const Regions& others) {
    return area_mm2(opening(subtract(some, others), 4));
  };
  for (const Um signed_by : {by, -by})
    for (const Corner corner : {Corner::round, Corner::miter}) {
      CAPTURE(signed_by, static_cast<int>(corner));
      const Regions ours = offset(shape, {.by = signed_by, .corner = corner, .arc_tolerance = 1});
      const Regions ours_swept = signed_by > 0 ? unite(shape, ours) : subtract(shape, ours);
      const auto least = swept(shape, {.by = signed_by, .corner = Corner::round});
      const auto most =
          swept(shape, {.by = signed_by, .corner = corner, .miter_limit = 2.1});  // 2, for rounded corners
      CHECK(wide_part_beyond(ours_swept, signed_by > 0 ? unite(shape, most) : most) == 0);
      CHECK(wide_part_beyond(signed_by > 0 ? least : intersect(shape, least), ours_swept) == 0);
    }
}

TEST_CASE("geometry: moving a region by whole microns moves its offset and changes nothing else", "[law]") {
  const Point by = GENERATE(Point{1, 0}, Point{-7, 90'001}, Point{12'345'677, -3'000'001});
  shapes::Dice dice(3);
  for (int i = 0; i < 20; ++i) {
    const Regions shape{{shapes::star(dice, {0, 0}, 9000, 30), {}}};
    tests::look_at(shape);
    for (const Um distance : {-900, -50, 333}) {
      const OffsetOptions options{.by = distance, .corner = i % 2 == 0 ? Corner::miter : Corner::round};
      CHECK(offset(moved(shape, by), options) == moved(offset(shape, options), by));
    }
  }
}

TEST_CASE("geometry: opening drops what is thin, closing fills what is narrow") {
  const Regions comb = unite({rectangle({0, 0}, {10000, 3000}), rectangle({1000, 2000}, {1300, 9000})});
  CHECK(area_mm2(opening(comb, 200, Corner::miter)) == Approx(30.0));
  CHECK(area_mm2(opening(comb, 100, Corner::miter)) == Approx(30.0 + 0.3 * 6).epsilon(0.0005));
  const Regions slotted{rectangle({0, 0}, {5000, 5000}), rectangle({5100, 0}, {9000, 5000})};
  CHECK(closing(slotted, 60, Corner::miter).size() == 1);
  CHECK(area_mm2(closing(slotted, 60, Corner::miter)) == Approx(45.0));
  CHECK(closing(slotted, 40, Corner::miter).size() == 2);
}

TEST_CASE("geometry: nothing in, nothing out") {
  CHECK(offset({}, {.by = 100}).empty());
  CHECK(offset({{{{0, 0}, {1000, 0}}, {}}}, {.by = -100}).empty());
  CHECK(unite({}).empty());
}
