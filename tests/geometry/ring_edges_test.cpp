// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/ring_edges.h"

#include "shapes.h"

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::geometry;
using shapes::rectangle;

namespace {

/// Rings of all kinds: rough, smooth, within each other, with level edges and corners on each other.
std::vector<Ring> some_rings(shapes::Dice& dice, int count, Um step) {
  std::vector<Ring> out;
  for (int i = 0; i < count; ++i) {
    const Point at{dice.between(-8000, 8000), dice.between(-8000, 8000)};
    Ring ring = dice.between(0, 3) == 0
                    ? rectangle(at, {at.x + dice.between(1, 6000), at.y + dice.between(1, 6000)}).outer
                    : shapes::star(dice, at, dice.between(500, 9000), dice.between(3, 60));
    for (Point& p : ring) p = {p.x / step * step, p.y / step * step};
    out.push_back(std::move(ring));
  }
  return out;
}

void check_as_index(const std::vector<Ring>& rings, shapes::Dice& dice) {
  const RingEdges edges(rings);
  const SegmentIndex index(rings);
  std::uint32_t i = 0;
  for (std::uint32_t r = 0; r < rings.size(); ++r)
    for (std::uint32_t k = 0; k < rings[r].size(); ++k, ++i) {
      CHECK(edges.ring_of(i) == r);
      CHECK(edges.edge(i) == index.segments()[i]);
    }
  CHECK(edges.first_of(rings.size()) == i);
  CHECK(edges.crossing_pairs() == index.crossing_pairs());
  CHECK(edges.clean_crossings() == index.clean_crossings());
  CHECK(edges.simple() == index.simple());
  const auto told = [](std::vector<SegmentIndex::RingWinding> found) {
    std::erase_if(found, [](const auto& w) { return w.winding == 0 && !w.on; });
    std::vector<std::tuple<std::uint32_t, int, bool>> out;
    for (const auto& w : found) out.emplace_back(w.ring, w.winding, w.on);
    return out;
  };
  std::vector<SegmentIndex::RingWinding> by_edges, by_index;
  for (int q = 0; q < 40; ++q) {
    const Ring& ring = rings[static_cast<std::size_t>(q) % rings.size()];
    const Point p = q % 2 == 0 ? ring[static_cast<std::size_t>(dice.between(0, static_cast<int>(ring.size()) - 1))]
                               : Point{dice.between(-9000, 9000), dice.between(-9000, 9000)};
    edges.windings(p, by_edges), index.windings(p, by_index);
    CHECK(told(by_edges) == told(by_index));
    if (index.box().contains(p)) CHECK(edges.first_left_of(p) == index.first_left_of(p));
  }
}

}  // namespace

TEST_CASE("geometry: rings looked at edge by edge tell what an index of their edges tells", "[law]") {
  shapes::Dice dice(61);
  for (int round = 0; round < 60; ++round) {
    check_as_index(some_rings(dice, dice.between(1, 8), 1), dice);
    check_as_index(some_rings(dice, dice.between(1, 4), 700), dice);  // corners and edges lie on each other
  }
}

TEST_CASE("geometry: of very many rings, and of edges that all come near each other, a grid tells the same") {
  shapes::Dice dice(62);
  std::vector<Ring> many, long_ones;
  for (int i = 0; i < 400; ++i) {
    const Point at{i % 20 * 700, i / 20 * 700};
    many.push_back(rectangle(at, {at.x + 400, at.y + 650}).outer);
    long_ones.push_back({{i * 30, 0}, {i * 30 + 9000, 9000}, {i * 30 + 9000, 9010}, {i * 30, 10}});
  }
  check_as_index(many, dice);
  check_as_index(long_ones, dice);
}

TEST_CASE("geometry: what goes one way twice crosses where one leans over the other") {
  const std::vector<Ring> leaf{{{0, 0}, {600, 200}, {1000, 1000}, {400, 800}}};
  const std::vector<Ring> knot{{{0, 0}, {600, 200}, {1000, 1000}, {800, 300}}};
  CHECK(RingEdges(leaf).simple());
  CHECK(RingEdges(knot).crossing_pairs() == SegmentIndex(knot).crossing_pairs());
}

TEST_CASE("geometry: rings tell edges that lie on the one before, and those without length") {
  const std::vector<Ring> spike{{{0, 0}, {1000, 0}, {1000, 500}, {1000, 200}, {0, 200}}};
  const std::vector<Ring> spike_at_seam{{{1000, 500}, {1000, 200}, {0, 200}, {0, 0}, {1000, 0}}};
  const std::vector<Ring> point{{{0, 0}, {1000, 0}, {1000, 0}, {0, 1000}}};
  for (const auto& rings : {spike, spike_at_seam, point}) {
    CHECK_FALSE(RingEdges(rings).clean_crossings());
    CHECK_FALSE(RingEdges(rings).simple());
    CHECK(RingEdges(rings).crossing_pairs().empty());
  }
}

TEST_CASE("geometry: eight boxes asked at once tell what each of them tells", "[law]") {
  shapes::Dice dice(63);
  const auto some_box = [&] {
    const Point at{dice.between(-20, 20), dice.between(-20, 20)};
    return Box{at, {at.x + dice.between(0, 9), at.y + dice.between(0, 9)}};
  };
  for (int round = 0; round < 2000; ++round) {
    EightBoxes boxes;
    std::uint32_t met = 0;
    const Box asked = some_box();
    for (std::uint32_t k = 0; k < EightBoxes::count; ++k) {
      if (dice.between(0, 4) == 0) continue;  // none is there
      const Box box = some_box();
      boxes.set(k, box);
      CHECK(boxes[k] == box);
      met |= std::uint32_t{box.overlaps(asked)} << k;
    }
    CHECK(boxes.meeting(asked) == met);
    CHECK(boxes.meeting_one_by_one(asked) == met);
    CHECK(boxes.meeting({{-max_coord, -max_coord}, {max_coord, max_coord}}) ==
          boxes.meeting_one_by_one({{-max_coord, -max_coord}, {max_coord, max_coord}}));
  }
}
