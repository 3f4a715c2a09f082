// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/spatial_index.h"

#include "geometry/boolean.h"
#include "geometry/clip_lines.h"
#include "picture.h"
#include "shapes.h"

#include <algorithm>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::geometry;
using shapes::rectangle;

namespace {
Regions some_regions(shapes::Dice& dice) {
  Regions stars;
  for (int i = 0; i < 6; ++i)
    stars.push_back(
        {shapes::star(dice, {dice.between(-20000, 20000), dice.between(-20000, 20000)}, 9000, dice.between(3, 80)),
         {}});
  Regions out = exclusive_or({stars.begin(), stars.begin() + 3}, {stars.begin() + 3, stars.end()});
  tests::look_at(out);
  return out;
}
Point anywhere(shapes::Dice& dice) {
  return {dice.between(-32000, 32000), dice.between(-32000, 32000)};
}

std::size_t region_by_brute_force(const Regions& regions, Point p) {
  for (std::size_t i = 0; i < regions.size(); ++i) {
    if (side_of(regions[i].outer, p) == Side::outside) continue;
    const auto& holes = regions[i].holes;
    if (std::none_of(holes.begin(), holes.end(), [&](const Ring& h) { return side_of(h, p) == Side::inside; }))
      return i;
  }
  return regions.size();
}
}  // namespace

TEST_CASE("geometry: the index finds what looking at every segment finds", "[law]") {
  shapes::Dice dice(31);
  for (int round = 0; round < 12; ++round) {
    const Regions regions = some_regions(dice);
    const SegmentIndex index(regions);
    const auto all = index.segments();
    std::vector<std::uint32_t> near;
    std::vector<SegmentIndex::Crossing> crossings;
    for (int i = 0; i < 300; ++i) {
      const Point p = i % 7 == 0 ? all[static_cast<std::size_t>(i) % all.size()].a : anywhere(dice), q = anywhere(dice);
      std::size_t best = 0;
      for (std::size_t k = 1; k < all.size(); ++k)
        if (foot_of(p, all[k]).distance_um < foot_of(p, all[best]).distance_um) best = k;
      const auto nearest = index.nearest(p);
      REQUIRE(nearest);
      CHECK(nearest->segment == best);
      CHECK(nearest->distance_um == foot_of(p, all[best]).distance_um);
      CHECK(distance(p, nearest->at) == Approx(nearest->distance_um).margin(1));
      CHECK(index.nearest(p, nearest->distance_um).has_value());
      CHECK_FALSE(index.nearest(p, nearest->distance_um * 0.999 - 1e-9).has_value());

      Box box;
      box.add(p), box.add(q);
      index.near(box, near);
      CHECK(index.any_near(box) == !near.empty());
      std::size_t found_crossings = 0;
      bool proper = false;
      index.crossings(p, q, crossings);
      for (std::size_t k = 0; k < all.size(); ++k) {
        if (segments_touch(p, q, all[k].a, all[k].b)) CHECK(std::binary_search(near.begin(), near.end(), k));
        proper |= segments_cross(p, q, all[k].a, all[k].b);
        found_crossings += (orient(p, q, all[k].a) > 0) != (orient(p, q, all[k].b) > 0) &&
                           (orient(all[k].a, all[k].b, p) > 0) != (orient(all[k].a, all[k].b, q) > 0);
      }
      CHECK(crossings.size() == found_crossings);
      CHECK(index.crosses(p, q) == proper);
      const std::size_t expected = region_by_brute_force(regions, p);
      CHECK(index.region_at(p).value_or(regions.size()) == expected);
      bool on = false;
      for (const auto& s : all) on |= segments_touch(s.a, s.b, p, p);
      CHECK(index.touches(p) == on);
      CHECK(index.winding(p).has_value() == !on);
      if (!on) CHECK(*index.winding(p) == (expected < regions.size() ? 1 : 0));
    }
  }
}

TEST_CASE("geometry: an index of nothing answers nothing") {
  const SegmentIndex index(Regions{});
  CHECK_FALSE(index.nearest({0, 0}));
  CHECK(index.winding({0, 0}) == 0);
  CHECK_FALSE(index.region_at({0, 0}));
  CHECK_FALSE(index.crosses({0, 0}, {1, 1}));
  CHECK(index.simple());
  CHECK(clip_lines(std::vector<Polyline>{{{0, 0}, {5, 5}}}, index).empty());
}

TEST_CASE("geometry: contact of rings is found, neighbourhood is none") {
  const auto simple = [](std::vector<Ring> rings) { return SegmentIndex(rings).simple(); };
  const Ring square = rectangle({0, 0}, {1000, 1000}).outer;
  CHECK(simple({square}));
  CHECK(simple({square, rectangle({1001, 0}, {2000, 1000}).outer}));
  CHECK_FALSE(simple({square, rectangle({1000, 500}, {2000, 1500}).outer}));   // edge on edge
  CHECK_FALSE(simple({square, rectangle({1000, 1000}, {2000, 2000}).outer}));  // corner on corner
  CHECK_FALSE(simple({square, {{1000, 500}, {1500, 400}, {1500, 600}}}));      // corner on edge
  CHECK_FALSE(simple({{{0, 0}, {1000, 1000}, {1000, 0}, {0, 1000}}}));         // crosses itself
  CHECK_FALSE(simple({{{0, 0}, {1000, 0}, {500, 0}, {500, 1000}}}));           // folds back
  CHECK_FALSE(simple({{{0, 0}, {1000, 0}, {1000, 0}, {500, 1000}}}));          // a point twice
}

TEST_CASE("geometry: a line is cut where it enters and leaves, keeps its direction and knows its source") {
  Region frame = rectangle({0, 0}, {10000, 10000});
  frame.holes.push_back(shapes::reversed(rectangle({4000, 4000}, {6000, 6000}).outer));
  const std::vector<Polyline> lines{{{20000, -500}, {20001, 500}}, {{11000, 5000}, {-1000, 5000}}};
  const auto inside = clip_lines(lines, {frame});
  REQUIRE(inside.size() == 2);
  CHECK(inside[0].line == Polyline{{10000, 5000}, {6000, 5000}});
  CHECK(inside[1].line == Polyline{{4000, 5000}, {0, 5000}});
  CHECK(inside[1].source == 1);
  const auto outside = clip_lines(lines, {frame}, Keep::outside);
  REQUIRE(outside.size() == 4);
  CHECK(outside[2].line == Polyline{{6000, 5000}, {4000, 5000}});
}

TEST_CASE("geometry: lines that start, bend and end on outlines and corners are cut right") {
  const Regions square{rectangle({0, 0}, {10000, 10000})};
  const auto pieces = [&](Polyline line) { return clip_lines(std::vector<Polyline>{std::move(line)}, square); };
  CHECK(pieces({{0, 0}, {10000, 10000}}).at(0).line == Polyline{{0, 0}, {10000, 10000}});
  CHECK(pieces({{0, 5000}, {5000, 5000}, {10000, 5000}, {12000, 5000}}).at(0).line ==
        Polyline{{0, 5000}, {5000, 5000}, {10000, 5000}});
  CHECK(pieces({{-1000, 5000}, {0, 5000}, {-1000, 6000}}).empty());
  CHECK(pieces({{0, 0}, {-1000, -1000}}).empty());
  const auto zigzag = pieces({{0, 2000}, {10000, 3000}, {0, 4000}});
  REQUIRE(zigzag.size() == 1);
  CHECK(zigzag[0].line.size() == 3);
  // An L: from the inner corner into the part, and out of it.
  const Regions ell = unite({rectangle({0, 0}, {10000, 5000}), rectangle({0, 0}, {5000, 10000})});
  const auto in_ell = [&](Polyline line) { return clip_lines(std::vector<Polyline>{std::move(line)}, ell); };
  CHECK(in_ell({{5000, 5000}, {1000, 1000}}).size() == 1);
  CHECK(in_ell({{5000, 5000}, {8000, 8000}}).empty());
  CHECK(in_ell({{5000, 5000}, {2000, 9000}}).size() == 1);
}

TEST_CASE("geometry: what is inside and what is outside of regions make up the line, on seeded stars", "[law]") {
  shapes::Dice dice(77);
  for (int round = 0; round < 40; ++round) {
    const Regions regions = some_regions(dice);
    std::vector<Polyline> lines(5);
    double total = 0;
    for (auto& line : lines) {
      for (int k = 0; k < 12; ++k)
        line.push_back(k % 4 == 0 ? regions[0].outer[static_cast<std::size_t>(k) % regions[0].outer.size()]
                                  : anywhere(dice));
      total += length_of(line);
    }
    double inside = 0, outside = 0;
    for (const auto& piece : clip_lines(lines, regions)) {
      inside += length_of(piece.line);
      for (std::size_t i = 1; i < piece.line.size(); ++i) {
        const Point middle = lerp(piece.line[i - 1], piece.line[i], 0.5);
        if (distance(piece.line[i - 1], piece.line[i]) > 20)
          CHECK(region_by_brute_force(regions, middle) < regions.size());
      }
    }
    for (const auto& piece : clip_lines(lines, regions, Keep::outside)) outside += length_of(piece.line);
    CHECK(inside > 0);
    CHECK(inside + outside == Approx(total).epsilon(1e-5));
  }
}
