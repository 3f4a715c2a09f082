// SPDX-License-Identifier: GPL-3.0-or-later
#include "travel/tour.h"

#include <algorithm>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::travel;

namespace {

std::vector<Stop> random_stops(std::size_t n, unsigned seed, bool fixed_ones) {
  std::mt19937 random(seed);
  const auto below = [&](unsigned m) { return static_cast<Um>(random() % m); };
  std::vector<Stop> stops;
  for (std::size_t i = 0; i < n; ++i) {
    const Point a{below(200000), below(200000)};
    const bool dot = random() % 4 == 0;
    stops.push_back({a, dot ? a : Point{a.x + below(3000), a.y + below(3000)}, !fixed_ones || random() % 10 != 0});
  }
  return stops;
}

bool is_permutation(std::span<const Stop> stops, const std::vector<Visit>& visits) {
  std::vector<int> seen(stops.size(), 0);
  for (const auto& v : visits) {
    ++seen[v.stop];
    if (v.reversed && !stops[v.stop].reversible) return false;
  }
  return std::all_of(seen.begin(), seen.end(), [](int k) { return k == 1; });
}

}  // namespace

TEST_CASE("travel: a tour visits every stop once, and what may not be turned around is not", "[travel][law]") {
  const auto n =
      GENERATE(std::size_t{0}, std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{17}, std::size_t{400});
  const auto order = GENERATE(PathOrder::nearest, PathOrder::optimized);
  for (unsigned seed = 0; seed < 5; ++seed) {
    const auto stops = random_stops(n, seed, true);
    CHECK(is_permutation(stops, tour(order, stops, {Point{0, 0}, std::nullopt})));
    CHECK(is_permutation(stops, tour(order, stops, {})));
  }
}

TEST_CASE("travel: an optimised tour is clearly shorter than nearest-neighbour", "[travel][law]") {
  for (unsigned seed = 0; seed < 5; ++seed) {
    const auto stops = random_stops(500, seed, seed % 2 == 1);
    const TourEnds ends{Point{0, 0}, Point{200000, 200000}};
    const double nearest = way(stops, tour(PathOrder::nearest, stops, ends), ends);
    const double optimized = way(stops, tour(PathOrder::optimized, stops, ends), ends);
    CHECK(optimized < 0.92 * nearest);
  }
}

TEST_CASE("travel: small tours are as short as any", "[travel]") {
  int best = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    const auto stops = random_stops(5, seed, false);
    const TourEnds ends{Point{100000, 100000}, std::nullopt};
    std::vector<std::uint32_t> sequence{0, 1, 2, 3, 4};
    double least = 1e18;
    do
      for (unsigned turned = 0; turned < 32; ++turned) {
        std::vector<Visit> visits;
        for (unsigned i = 0; i < 5; ++i) visits.push_back({sequence[i], (turned >> i & 1) != 0});
        least = std::min(least, way(stops, visits, ends));
      }
    while (std::next_permutation(sequence.begin(), sequence.end()));
    const double found = way(stops, tour(PathOrder::optimized, stops, ends), ends);
    CHECK(found < 1.35 * least);
    if (found < least + 1) ++best;
  }
  CHECK(best > 25);
}

TEST_CASE("travel: no tour is shorter than the bound, and good ones are near it", "[travel][law]") {
  for (unsigned seed = 0; seed < 6; ++seed) {
    const TourEnds ends = seed % 2 == 0 ? TourEnds{Point{0, 0}, Point{200000, 200000}} : TourEnds{};
    for (const std::size_t n : {std::size_t{1}, std::size_t{7}, std::size_t{150}}) {
      const auto stops = random_stops(n, seed, false);
      const double least = least_way(stops, ends);
      const double made = way(stops, tour(PathOrder::optimized, stops, ends), ends);
      CHECK(least <= made + 1);
      if (n > 1) CHECK(made < (n < 10 ? 1.6 : 1.25) * least);
      CHECK(least <= way(stops, tour(PathOrder::nearest, stops, ends), ends) + 1);
    }
  }
  const Stop line{{0, 0}, {1000, 0}};
  CHECK(least_way(std::vector{line}, {Point{-500, 0}, Point{3000, 0}}) == Approx(2500));
}

TEST_CASE("travel: moving all stops by whole microns does not change a tour", "[travel][law]") {
  auto stops = random_stops(300, 7, true);
  const auto before = tour(PathOrder::optimized, stops, {Point{0, 0}, Point{9, 9}});
  const Point by{-12345, 999999};
  for (auto& s : stops) s.a = s.a + by, s.b = s.b + by;
  CHECK(tour(PathOrder::optimized, stops, {by, Point{9, 9} + by}) == before);
}

TEST_CASE("travel: stops in one place make a tour", "[travel]") {
  std::vector<Stop> stops(200, {{5, 5}, {5, 5}, true});
  CHECK(is_permutation(stops, tour(PathOrder::optimized, stops, {Point{0, 0}, std::nullopt})));
  std::vector<Stop> row;
  for (Um i = 0; i < 1000; ++i) row.push_back({{i * 100, 0}, {i * 100 + 50, 0}, true});
  const TourEnds ends{Point{0, 0}, std::nullopt};
  CHECK(way(row, tour(PathOrder::optimized, row, ends), ends) == Approx(999 * 50.0));
}
