// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/noise.h"

#include <cmath>
#include <set>

#include <catch2/catch.hpp>

using namespace weft;

TEST_CASE("noise: it stays within its bounds, fills them, and its mean is about the middle") {
  const auto look = [](auto f) {
    double least = 1, most = -1, sum = 0;
    int count = 0;
    for (int i = 0; i < 40; ++i)
      for (int j = 0; j < 40; ++j, ++count) {
        const double v = f(noise::Place{0.37 * i, 0.41 * j, 0.13 * (i + j)});
        least = std::min(least, v), most = std::max(most, v), sum += v;
      }
    CHECK(least >= -1);
    CHECK(most <= 1);
    CHECK(most - least > 1);
    return sum / count;
  };
  CHECK(std::abs(look([](noise::Place p) { return noise::perlin(7, p, 1); })) < 0.1);
  CHECK(std::abs(look([](noise::Place p) { return noise::perlin(7, p, 4); })) < 0.1);
  CHECK(std::abs(look([](noise::Place p) { return noise::voronoi(7, p); })) < 0.2);
  look([](noise::Place p) { return noise::billow(7, p, 3); });
  look([](noise::Place p) { return noise::ridged(7, p, 3); });
}

TEST_CASE("noise: near places have near values but for the edges of plates, and seeds differ") {
  double worst = 0;
  std::set<double> plates;
  for (int i = 0; i < 2000; ++i) {
    const noise::Place at{0.01 * i, 2.5, -1.25}, next{0.01 * (i + 1), 2.5, -1.25};
    worst = std::max(worst, std::abs(noise::perlin(1, at, 1) - noise::perlin(1, next, 1)));
    plates.insert(noise::voronoi(1, at));
  }
  CHECK(worst < 0.05);
  CHECK(plates.size() > 10);
  CHECK(plates.size() < 60);
  CHECK(noise::perlin(1, {0.3, 0.4, 0.5}, 2) != noise::perlin(2, {0.3, 0.4, 0.5}, 2));
  // What whole numbers make of it is the same on every machine.
  CHECK(noise::perlin(0, {2, 3, 4}, 1) == 0);
}
