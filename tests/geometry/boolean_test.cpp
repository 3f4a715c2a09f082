// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/boolean.h"

#include "geometry/clipper_door.h"
#include "geometry/spatial_index.h"
#include "geometry/traced.h"
#include "picture.h"
#include "shapes.h"

#include <algorithm>
#include <array>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::geometry;
using shapes::rectangle;

namespace {
/// Area of what differs where each corner may be a micron off: a micron along half of the outlines, at most.
double rounding_mm2(const Regions& regions) {
  double um = 0;
  for (const Ring& ring : rings_of(regions))
    for (std::size_t i = 0; i < ring.size(); ++i) um += distance(ring[i], ring[(i + 1) % ring.size()]);
  return um / 2 * 1e-6;
}
}  // namespace

TEST_CASE("geometry: areas obey inclusion and exclusion, on seeded stars", "[law]") {
  shapes::Dice dice(5);
  for (int i = 0; i < 60; ++i) {
    const Regions a{{shapes::star(dice, {0, 0}, 9000, dice.between(3, 50)), {}}};
    const Regions b{
        {shapes::star(dice, {dice.between(-6000, 6000), dice.between(-6000, 6000)}, 9000, dice.between(3, 50)), {}}};
    tests::look_at(a, b);
    const double both = area_mm2(intersect(a, b)), either = area_mm2(unite(a, b));
    const double margin = 0.01;  // mm²: rounding of the crossings, and slivers
    CHECK(both + either == Approx(area_mm2(a) + area_mm2(b)).margin(margin));
    CHECK(area_mm2(subtract(a, b)) == Approx(area_mm2(a) - both).margin(margin));
    CHECK(area_mm2(exclusive_or(a, b)) == Approx(either - both).margin(margin));
  }
}

TEST_CASE("geometry: both sides of a cut are what intersecting and subtracting give", "[law]") {
  shapes::Dice dice(9);
  const auto check = [](const Regions& what, const Regions& by) {
    tests::look_at(what, by);
    const Cut sides = cut(what, by);
    CHECK(exclusive_or(sides.inside, intersect(what, by)).empty());
    CHECK(exclusive_or(sides.outside, subtract(what, by)).empty());
  };
  for (int i = 0; i < 60; ++i) {
    const Point at{dice.between(-20000, 20000), dice.between(-6000, 6000)};  // some apart
    check({{shapes::star(dice, {0, 0}, 9000, dice.between(3, 50)), {}}},
          {{shapes::star(dice, at, 9000, dice.between(3, 50)), {}}});
  }
  Regions many;  // more than are swept at once
  for (Um x = 0; x < 20; ++x)
    for (Um y = 0; y < 20; ++y) many.push_back(rectangle({x * 3000, y * 3000}, {x * 3000 + 2000, y * 3000 + 2000}));
  check(many, {{shapes::star(dice, {30000, 30000}, 25000, 30), {}}});
  check({}, many);
  check(many, {});
}

TEST_CASE("geometry: outers come back counter-clockwise, holes clockwise, islands as regions of their own") {
  const Regions plate{rectangle({0, 0}, {30000, 30000})};
  const Regions ring = subtract(plate, {rectangle({5000, 5000}, {25000, 25000})});
  const Regions all = unite(ring, {rectangle({10000, 10000}, {20000, 20000})});
  REQUIRE(all.size() == 2);
  std::size_t holes = 0;
  for (const auto& region : all) {
    CHECK(double_area(region.outer) > 0);
    for (const auto& hole : region.holes) CHECK(double_area(hole) < 0);
    holes += region.holes.size();
  }
  CHECK(holes == 1);
  CHECK(area_mm2(all) == Approx(900.0 - 400 + 100));
}

TEST_CASE("geometry: the winding rule decides what rings enclose") {
  const Ring big = rectangle({0, 0}, {10000, 10000}).outer, small = rectangle({2000, 2000}, {4000, 4000}).outer;
  const std::vector<Ring> same{big, small}, opposite{big, shapes::reversed(small)};
  CHECK(area_mm2(regions_from_rings(same)) == Approx(100.0));
  CHECK(area_mm2(regions_from_rings(opposite)) == Approx(96.0));
  CHECK(area_mm2(regions_from_rings(same, WindingRule::even_odd)) == Approx(96.0));
  const std::vector<Ring> inside_out{shapes::reversed(big)};
  CHECK(area_mm2(regions_from_rings(inside_out)) == Approx(100.0));
  CHECK(regions_from_rings(inside_out, WindingRule::positive).empty());
}

TEST_CASE("geometry: a ring that crosses itself becomes proper regions") {
  const std::vector<Ring> bow_tie{{{0, 0}, {10000, 10000}, {10000, 0}, {0, 10000}}};
  const Regions parts = regions_from_rings(bow_tie);
  CHECK(area_mm2(parts) == Approx(50.0));
  for (const auto& part : parts) CHECK(double_area(part.outer) > 0);
}

TEST_CASE("geometry: slivers are dropped") {
  const Regions plate{rectangle({0, 0}, {10000, 10000})};
  CHECK(subtract(plate, {rectangle({0, 0}, {9999, 10000})}).size() == 1);
  CHECK(subtract(plate, {rectangle({0, 15}, {10000, 10000}), rectangle({20, 0}, {10000, 10000})}).empty());
}

TEST_CASE("geometry: moving the input of a Boolean by whole microns moves the output", "[law]") {
  const Point by = GENERATE(Point{1, 0}, Point{-7, 90'001}, Point{12'345'677, -3'000'001});
  shapes::Dice dice(9);
  for (int i = 0; i < 30; ++i) {
    const Regions a{{shapes::star(dice, {0, 0}, 9000, 25), {}}}, b{{shapes::star(dice, {3000, 1000}, 9000, 25), {}}};
    tests::look_at(a, b);
    CHECK(intersect(moved(a, by), moved(b, by)) == moved(intersect(a, b), by));
    CHECK(subtract(moved(a, by), moved(b, by)) == moved(subtract(a, b), by));
  }
}

TEST_CASE("geometry: rings that keep apart are nested as a sweep would, without moving a point", "[law]") {
  shapes::Dice dice(41);
  for (const WindingRule rule : {WindingRule::nonzero, WindingRule::positive, WindingRule::even_odd}) {
    for (int round = 0; round < 40; ++round) {
      // A tree of squares, each somewhere in one of four quarters of its parent, wound by chance.
      std::vector<Ring> rings;
      std::vector<std::pair<Point, Um>> squares{{{dice.between(-9000, 9000), 0}, 100000}};
      for (std::size_t i = 0; i < squares.size() && squares.size() < 60; ++i) {
        const auto [corner, size] = squares[i];
        rings.push_back(rectangle(corner, corner + Point{size, size}).outer);
        if (dice.share() < 0.4) rings.back() = shapes::reversed(rings.back());
        for (const Point q : {Point{0, 0}, Point{1, 0}, Point{0, 1}, Point{1, 1}})
          if (dice.share() < 0.6 && size > 2000)
            squares.push_back({corner + Point{q.x * size / 2 + 100, q.y * size / 2 + 100}, size / 2 - 300});
      }
      const Regions fast = regions_from_rings(rings, rule);
      rings.push_back(rings.front());  // a contact: by the sweep
      rings.push_back(shapes::reversed(rings.front()));
      const Regions swept = regions_from_rings(rings, rule);
      CHECK(area_mm2(fast) == Approx(area_mm2(swept)).margin(1e-9));
      CHECK(fast.size() == swept.size());
      CHECK(area_mm2(exclusive_or(fast, swept)) == 0);
      for (const auto& region : fast) {
        CHECK(double_area(region.outer) > 0);
        for (const auto& hole : region.holes) CHECK(double_area(hole) < 0);
      }
    }
  }
}

TEST_CASE("geometry: no edges cross after a Boolean, also where hundreds of crossings are rounded", "[law]") {
  shapes::Dice dice(61);
  for (int round = 0; round < 60; ++round) {
    std::vector<Ring> rings(3);
    for (auto& ring : rings)
      for (int i = 0; i < 15; ++i) ring.push_back({dice.between(0, 6000), dice.between(0, 3000)});
    const Regions regions = regions_from_rings(rings, WindingRule::even_odd);
    tests::look_at(regions);
    CHECK(SegmentIndex(regions).crossing_pairs().empty());
    for (const auto& region : regions) CHECK(double_area(region.outer) > 0);
  }
}

TEST_CASE("geometry: a thousand places worked on at once are the places one by one", "[law]") {
  shapes::Dice dice(11);
  constexpr int side = 32;
  constexpr Um pitch = 12'000;
  Regions all, bites, expected_cut, expected_union;
  for (int i = 0; i < side * side; ++i) {
    const Point at{pitch * (i % side), pitch * (i / side)};
    // a plate with a star for a hole, and islands of islands in that
    const Ring outer = rectangle(at - Point{5000, 5000}, at + Point{5000, 5000}).outer;
    const Regions place = subtract({{outer, {}}}, {{shapes::star(dice, at, 4000, dice.between(3, 12)), {}}});
    const Regions middle{{shapes::star(dice, at, 700, 5), {}}};
    const Regions here = unite(place, middle);
    const Regions bite{{shapes::star(dice, at + Point{dice.between(-4000, 4000), 3000}, 2500, 7), {}}};
    all.insert(all.end(), here.begin(), here.end());
    bites.insert(bites.end(), bite.begin(), bite.end());
    for (const auto& r : subtract(here, bite)) expected_cut.push_back(r);
    for (const auto& r : unite(here, bite)) expected_union.push_back(r);
  }
  const auto sorted = [](Regions regions) {
    for (auto& region : regions) {
      const auto turned = [](Ring& ring) {
        std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end()), ring.end());
      };
      turned(region.outer);
      for (auto& hole : region.holes) turned(hole);
      std::sort(region.holes.begin(), region.holes.end());
    }
    std::sort(regions.begin(), regions.end(), [](const Region& a, const Region& b) { return a.outer < b.outer; });
    return regions;
  };
  // Crossings of one place are rounded once, those of a sweep by way of a finer grid: a micron beside each other at
  // most.
  const auto alike = [](const Regions& a, const Regions& b) {
    CHECK(a.size() == b.size());
    CHECK(rings_of(a).size() == rings_of(b).size());
    CHECK(area_mm2(exclusive_or(a, b)) <= rounding_mm2(a));
  };
  alike(subtract(all, bites), expected_cut);
  alike(unite(all, bites), expected_union);
  CHECK((sorted(regions_from_rings(rings_of(all))) == sorted(all)));
}

TEST_CASE("geometry: rings nested deep, many times, are told apart by both rules") {
  constexpr int side = 20, deep = 6;
  std::vector<Ring> rings;
  for (int i = 0; i < side * side; ++i)
    for (int k = 0; k < deep; ++k) {
      const Point at{20'000 * (i % side), 20'000 * (i / side)}, reach{9000 - 1400 * k, 9000 - 1300 * k};
      const Ring ring = rectangle(at - reach, at + reach).outer;
      rings.push_back((i + k) % 3 == 0 ? shapes::reversed(ring) : ring);
    }
  const Ring frame = rectangle({-15'000, -15'000}, {20'000 * side, 20'000 * side}).outer;
  rings.push_back(frame);
  const Regions stripes = regions_from_rings(rings, WindingRule::even_odd);
  CHECK(stripes.size() == 1 + side * side * deep / 2);
  CHECK(std::count_if(stripes.begin(), stripes.end(), [](const Region& r) { return r.holes.size() == 1; }) ==
        side * side * (deep / 2 - 1));
  CHECK(std::count_if(stripes.begin(), stripes.end(), [](const Region& r) { return r.holes.size() == side * side; }) ==
        1);
}

TEST_CASE("geometry: plates full of holes are what each place of them is", "[law]") {
  // Two sets, each of plates that lie on each other, so that holes are wound around more than once; and the second's
  // outline runs through the outermost holes.
  using namespace clipper;
  shapes::Dice dice(23);
  constexpr int side = 20;
  constexpr Um pitch = 6000, end = pitch * side;
  const auto plates = [&](Um aside, int count) {
    std::vector<Ring> rings;
    for (int i = 0; i < count; ++i)
      rings.push_back(rectangle(aside - 400 * i, aside - 300 * i, end + aside + 500 * i, end - aside + 200 * i).outer);
    for (int i = 0; i < side * side; ++i) {
      const Point at{pitch * (i % side) + pitch / 2, pitch * (i / side) + pitch / 2};
      for (int k = 0; k < count; ++k) rings.push_back(shapes::reversed(shapes::star(dice, at, 2800, 9)));
      if (i % 3 == 0) rings.push_back(shapes::convex(dice, at, 500, 6));
    }
    return rings;
  };
  const std::vector<Ring> a = plates(0, 2), b = plates(2500, 1);
  const auto fine = [](const std::vector<Ring>& rings) {
    FineRings out;
    for (const Ring& ring : rings) {
      out.emplace_back();
      for (const Point p : ring) out.back().push_back({std::int64_t{p.x} * steps, std::int64_t{p.y} * steps});
    }
    return out;
  };
  const SegmentIndex index_of_a(a), index_of_b(b);
  const auto winding = [](const SegmentIndex& index, Point p) {
    std::vector<SegmentIndex::RingWinding> found;
    index.windings(p, found);
    int sum = 0;
    for (const auto& w : found) sum += w.winding;
    return sum;
  };
  for (const WindingRule rule : {WindingRule::positive, WindingRule::nonzero, WindingRule::even_odd})
    for (const Operation operation :
         {Operation::unite, Operation::intersect, Operation::subtract, Operation::exclusive_or}) {
      const SegmentIndex result(run(operation, rule, fine(a), fine(b), {}));
      const auto solid = [rule](int w) {
        return rule == WindingRule::positive ? w > 0 : rule == WindingRule::nonzero ? w != 0 : w % 2 != 0;
      };
      int wrong = 0, inside = 0, told = 0;
      while (told < 4000) {
        const Point p{dice.between(-3000, end + 3000), dice.between(-3000, end + 3000)};
        constexpr double rounded_um = 2;
        if (index_of_a.nearest(p, rounded_um) || index_of_b.nearest(p, rounded_um)) continue;
        const bool in_a = solid(winding(index_of_a, p)), in_b = solid(winding(index_of_b, p));
        const bool in = operation == Operation::unite       ? in_a || in_b
                        : operation == Operation::intersect ? in_a && in_b
                        : operation == Operation::subtract  ? in_a && !in_b
                                                            : in_a != in_b;
        ++told, inside += in ? 1 : 0;
        wrong += in != result.region_at(p).has_value() ? 1 : 0;
      }
      CHECK(wrong == 0);
      CHECK(inside > 100);
    }
}

TEST_CASE("geometry: thousands of regions are cut and subtracted as each of them would be", "[geometry]") {
  // More than are given to the library at once; what is taken away lies across several of them.
  Regions many, bars;
  for (Um i = 0; i < 40; ++i)
    for (Um k = 0; k < 40; ++k) many.push_back(rectangle(3_mm * i, 3_mm * k, 3_mm * i + 2_mm, 3_mm * k + 2_mm));
  for (Um i = 0; i < 40; ++i) bars.push_back(rectangle(3_mm * i + 500, -1_mm, 3_mm * i + 1000, 119_mm));
  const double taken = 40 * 40 * 0.5 * 2;
  CHECK(area_mm2(geometry::subtract(many, bars)) == Approx(40 * 40 * 4 - taken));
  CHECK(area_mm2(geometry::intersect(many, bars)) == Approx(taken));
  const auto cut = geometry::cut(many, bars);
  CHECK(cut.inside.size() == 1600);
  CHECK(cut.outside.size() == 3200);
  CHECK(geometry::subtract(many, {}).size() == 1600);
  CHECK(geometry::intersect(many, {}).empty());
  CHECK(geometry::cut(many, {rectangle(-5_mm, -5_mm, -4_mm, -4_mm)}).outside.size() == 1600);
}

TEST_CASE("geometry: outlines that are followed enclose what a sweep finds", "[law]") {
  using clipper::Operation;
  shapes::Dice dice(31);
  constexpr std::array operations{Operation::intersect, Operation::subtract, Operation::unite};
  int followed = 0;
  for (int i = 0; i < 300; ++i) {
    const auto ring_of = [&](Point at, Um radius) { return shapes::star(dice, at, radius, dice.between(3, 40)); };
    const auto ring_with_hole = [&](Point at) {
      return subtract({{ring_of(at, 9000), {}}}, {{ring_of(at, 4000), {}}});
    };
    const Regions a = ring_with_hole({0, 0}),
                  b = ring_with_hole({dice.between(-15000, 15000), dice.between(-6000, 6000)});
    const auto rings = traced(operations, a, b);
    if (!rings) continue;
    ++followed;
    const auto fine = [](const Regions& regions) {
      clipper::FineRings out;
      for (const Ring& ring : rings_of(regions)) {
        out.emplace_back();
        for (const Point p : ring)
          out.back().push_back({std::int64_t{p.x} * clipper::steps, std::int64_t{p.y} * clipper::steps});
      }
      return out;
    };
    const auto swept = clipper::run(operations, WindingRule::nonzero, fine(a), fine(b), {});
    for (std::size_t k = 0; k < operations.size(); ++k) {
      const Regions found = clipper::tidied((*rings)[k], {});
      CHECK(found.size() == swept[k].size());
      CHECK(area_mm2(exclusive_or(found, swept[k])) <= rounding_mm2(swept[k]));
    }
  }
  CHECK(followed > 250);
}

TEST_CASE("geometry: outlines that touch are swept, not followed") {
  using clipper::Operation;
  constexpr std::array both{Operation::intersect, Operation::subtract};
  const Regions square{rectangle({0, 0}, {10000, 10000})};
  const auto followed = [&](const Regions& by) { return traced(both, square, by).has_value(); };
  CHECK(followed({rectangle({5000, 5000}, {15000, 15000})}));
  CHECK(followed({rectangle({2000, 2000}, {3000, 3000})}));
  CHECK(followed({rectangle({20000, 0}, {30000, 10000})}));
  CHECK_FALSE(followed(square));
  CHECK_FALSE(followed({rectangle({10000, 0}, {20000, 10000})}));                // a common edge
  CHECK_FALSE(followed({rectangle({5000, 10000}, {6000, 12000})}));              // lies on an edge
  CHECK_FALSE(followed({{{{5000, 5000}, {10000, 10000}, {5000, 15000}}, {}}}));  // a corner on a corner
  CHECK_FALSE(followed({{{{10000, 5000}, {15000, 2000}, {15000, 8000}}, {}}}));  // a corner on an edge
  CHECK_FALSE(followed({rectangle({1000, 1000}, {9000, 9000}), rectangle({2000, 2000}, {8000, 8000})}));  // winds twice
  CHECK_FALSE(
      followed({rectangle({-1000, 1000}, {5000, 9000}), rectangle({4000, 2000}, {8000, 8000})}));  // cross each other
}
