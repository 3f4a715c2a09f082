// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/open_walls.h"

#include "travel/box_tree.h"
#include "travel/wall_order.h"

#include <algorithm>
#include <limits>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::travel;

namespace {

struct Case {
  Beads beads;
  std::vector<Turn> turns;
  TourEnds ends;
};

/// Closed walls and open ones on a coarse lattice, so that many ways are equally long.
Case random_case(std::size_t n, unsigned seed) {
  std::mt19937 random(seed);
  const auto below = [&](unsigned m) { return static_cast<Um>(random() % m); };
  const auto point = [&] { return Point{1000 * below(30), 1000 * below(30)}; };
  Case out;
  for (std::uint32_t i = 0; i < n; ++i) {
    Bead bead;
    bead.role = Role::inner_wall;
    bead.closed = random() % 3 == 0;
    const Point a = point();
    bead.path = {
        {a, 450, 1.0F}, {a + Point{1000 * below(3), 1000 * below(3)}, 450, 1.0F}, {a + Point{500, 0}, 450, 1.0F}};
    out.turns.push_back({0, i, {0, a}, !bead.closed && random() % 2 == 0});
    out.beads.push_back(std::move(bead));
  }
  if (random() % 2 == 0) out.ends.from = point();
  if (random() % 2 == 0) out.ends.to = point();
  return out;
}

double way(const Case& c, const std::vector<Turn>& turns) {
  double sum = 0;
  std::optional<Point> at = c.ends.from;
  for (const auto& t : turns) {
    if (at) sum += distance(*at, begin_of(c.beads[t.bead], t));
    at = end_of(c.beads[t.bead], t);
  }
  return at && c.ends.to ? sum + distance(*at, *c.ends.to) : sum;
}

/// The turns with those from first on taken out and put before what then is at `gap`.
std::vector<Turn> moved(std::vector<Turn> turns, std::size_t first, std::size_t length, std::size_t gap, bool turned) {
  const auto at = [&](std::size_t i) { return turns.begin() + static_cast<std::ptrdiff_t>(i); };
  std::vector<Turn> run(at(first), at(first + length));
  turns.erase(at(first), at(first + length));
  if (turned) {
    std::reverse(run.begin(), run.end());
    for (auto& t : run) t.reversed = !t.reversed;
  }
  turns.insert(at(gap), run.begin(), run.end());
  return turns;
}

}  // namespace

TEST_CASE("travel: open walls are left where no run of up to four of them would shorten the way", "[travel][law]") {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const auto c = random_case(1 + seed % 24, seed);
    auto turns = c.turns;
    for (int again = 0; again < 10; ++again) fit_open_walls(c.beads, turns, c.ends);
    INFO("seed " << seed);
    const double settled = way(c, turns);
    CHECK(settled <= way(c, c.turns) + 1e-6);
    for (std::size_t first = 0; first < turns.size(); ++first)
      for (std::size_t length = 1; length <= 4 && first + length <= turns.size(); ++length) {
        if (c.beads[turns[first + length - 1].bead].closed) break;
        for (std::size_t gap = 0; gap + length <= turns.size(); ++gap)
          for (const bool turned : {false, true})
            CHECK(way(c, moved(turns, first, length, gap, turned)) > settled - 1.01);
      }
  }
}

TEST_CASE("travel: fitting open walls in keeps every turn, and the closed ones in their order", "[travel][law]") {
  for (unsigned seed = 0; seed < 8; ++seed) {
    const auto c = random_case(3000, seed);
    auto turns = c.turns;
    fit_open_walls(c.beads, turns, c.ends);
    CHECK(way(c, turns) < 0.8 * way(c, c.turns));
    const auto closed_of = [&](const std::vector<Turn>& list) {
      std::vector<std::uint32_t> beads;
      for (const auto& t : list)
        if (c.beads[t.bead].closed) beads.push_back(t.bead);
      return beads;
    };
    CHECK(closed_of(turns) == closed_of(c.turns));
    std::vector<std::uint32_t> seen;
    for (const auto& t : turns) seen.push_back(t.bead);
    std::sort(seen.begin(), seen.end());
    for (std::uint32_t i = 0; i < seen.size(); ++i) REQUIRE(seen[i] == i);
  }
}

TEST_CASE("travel: a tree of boxes finds the nearest of those that are there, and looks at few", "[travel][law]") {
  std::mt19937 random(1);
  const auto below = [&](unsigned m) { return static_cast<Um>(random() % m); };
  for (const std::size_t n : {std::size_t{1}, std::size_t{7}, std::size_t{40}, std::size_t{3000}}) {
    std::vector<Box> boxes;
    for (std::size_t i = 0; i < n; ++i) {
      const Point a{below(100'000), below(100'000)};
      boxes.push_back({a, a + Point{below(900), below(900)}});
    }
    BoxTree tree(boxes);
    std::vector<char> there(n, 0);
    std::size_t looks = 0, searches = 0;
    for (int k = 0; k < 2000; ++k) {
      const auto i = static_cast<std::uint32_t>(random() % n);
      there[i] = !there[i];
      if (random() % 4 == 0) boxes[i] = {{below(100'000), 0}, {100'000, 90'000}};
      tree.set(i, there[i] ? boxes[i] : Box{});
      const Point p{below(100'000), below(100'000)};
      double nearest2 = std::numeric_limits<double>::max(), expected2 = nearest2;
      tree.search(
          nearest2, [&](const Box& box, double) { return distance2_to(box, p); },
          [&](std::uint32_t found) {
            CHECK(there[found]);
            ++looks;
            return nearest2 = std::min(nearest2, distance2_to(boxes[found], p));
          });
      ++searches;
      for (std::size_t j = 0; j < n; ++j)
        if (there[j]) expected2 = std::min(expected2, distance2_to(boxes[j], p));
      REQUIRE(nearest2 == expected2);
    }
    CHECK(looks <= 200 * searches);
  }
}
