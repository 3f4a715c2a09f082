// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/simplify.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;

namespace {

double length(const PathVertex& a, const PathVertex& b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

/// What a path lays, µm².
double laid(const VertexPath& path, bool closed) {
  double sum = 0;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < path.size(); ++i) {
    const PathVertex &a = path[i], &b = path[(i + 1) % path.size()];
    sum += length(a, b) * (a.band + b.band) / 2;
  }
  return sum;
}

/// How far p lies off a path, µm.
double off(const VertexPath& path, const PathVertex& p, bool closed) {
  double best = 1e18;
  for (std::size_t i = 0; i + (closed ? 0 : 1) < path.size(); ++i) {
    const PathVertex &a = path[i], &b = path[(i + 1) % path.size()];
    const double x = b.x - a.x, y = b.y - a.y, u = p.x - a.x, v = p.y - a.y, l2 = x * x + y * y;
    const double t = l2 > 0 ? std::clamp((u * x + v * y) / l2, 0.0, 1.0) : 0;
    best = std::min(best, std::hypot(u - t * x, v - t * y));
  }
  return best;
}

VertexPath walk(std::mt19937& random) {
  VertexPath path{{0, 0, 400}};
  double way = 0;
  for (int i = 0; i < 200; ++i) {
    way += (static_cast<double>(random() % 1000) / 500 - 1) * (i % 7 == 0 ? 3 : 0.2);
    const double by = 1 + static_cast<double>(random() % 150'000) / 1000;  // of which no two are equal
    const PathVertex& last = path.back();
    path.push_back(
        {last.x + by * std::cos(way), last.y + by * std::sin(way), 300.0 + static_cast<double>(random() % 200)});
  }
  return path;
}

}  // namespace

TEST_CASE("simplify: a circle becomes a polygon that lies on both sides of it and lays as much") {
  for (const double radius : {200.0, 500.0, 1'000.0, 20'000.0}) {
    VertexPath fine;
    const int n = 720;
    for (int i = 0; i < n; ++i) {
      const double a = 2 * std::numbers::pi * i / n;
      fine.push_back({radius * std::cos(a), radius * std::sin(a), 400});
    }
    VertexPath few = fine;
    simplify(few, true);
    CAPTURE(radius, few.size());
    CHECK(static_cast<double>(few.size()) < 6 + 5 * std::sqrt(radius / 10));
    // A polygon as large as a circle is longer; an even bead stays even.
    CHECK(laid(few, true) == Approx(laid(fine, true)).epsilon(0.002));
    CHECK(std::all_of(few.begin(), few.end(), [&](const PathVertex& v) { return v.band == few[0].band; }));
    double most = 0;
    for (const PathVertex& v : fine) most = std::max(most, off(few, v, true));
    CHECK(most < tolerances::path);  // two thirds of what chords through its points would
    double inside = 0, outside = 0;
    for (const PathVertex& v : few)
      inside = std::max(inside, radius - std::hypot(v.x, v.y)),
      outside = std::max(outside, std::hypot(v.x, v.y) - radius);
    CHECK(outside > 1);
    CHECK(inside < 1);
  }
}

TEST_CASE("simplify: where a path turns back along itself it is not cut off askew") {
  // On, back within some microns of its own line, and off at a right angle: to one line there and back are alike.
  for (const double back : {100.0, 200.0, 300.0}) {
    const double x = 3'500 - back;
    const VertexPath path{{0, 0, 400}, {3'000, 0, 400}, {3'500, 5, 400}, {x, 10, 400}, {x, -3'000, 400}};
    VertexPath simple = path;
    simplify(simple, false);
    double most = 0;
    for (std::size_t i = 1; i < simple.size(); ++i)
      for (int k = 0; k <= 100; ++k) most = std::max(most, off(path, lerp(simple[i - 1], simple[i], k / 100.0), false));
    CAPTURE(back, simple.size());
    CHECK(most < 2 * tolerances::path);  // cut off they lay 0.1 to 0.28 mm beside the path
  }
}

TEST_CASE("simplify: no path turns by more than 60° beside a piece shorter than a move") {
  std::mt19937 random(7);
  for (int n = 0; n < 300; ++n) {
    const VertexPath path = walk(random);
    VertexPath simple = path;
    const auto before = simplify(simple, false);
    REQUIRE(simple.size() >= 2);
    REQUIRE(before.size() == simple.size());
    CHECK(std::is_sorted(before.begin(), before.end()));
    CHECK(simple.front() == PathVertex{path.front().x, path.front().y, simple.front().band});
    CHECK(simple.back() == PathVertex{path.back().x, path.back().y, simple.back().band});
    for (std::size_t i = 1; i + 1 < simple.size(); ++i) {
      const PathVertex &a = simple[i - 1], &b = simple[i], &c = simple[i + 1];
      const double in = length(a, b), on = length(b, c);
      const double cosine = ((b.x - a.x) * (c.x - b.x) + (b.y - a.y) * (c.y - b.y)) / (in * on);
      CAPTURE(in, on, i, simple.size(), n);
      if (std::min(in, on) < tolerances::least_move - 1e-6) CHECK(cosine >= 0.5);  // turns by no more than 60°
    }
  }
}

TEST_CASE("simplify: a bow becomes as many pieces as are worth their moves, and no more") {
  // For an even bow of radius r in n pieces of length l: n + n l (l² / 8 r)² 4 / 45 / A is least; A is 10,000 µm³.
  for (const double radius : {500.0, 2'000.0, 10'000.0}) {
    VertexPath bow;
    for (int i = 0; i <= 3'600; ++i) {
      const double a = std::numbers::pi * i / 3'600;
      bow.push_back({radius * std::cos(a), radius * std::sin(a), 400});
    }
    const auto cost = [&](double n) {
      const double l = std::numbers::pi * radius / n, stands_off = l * l / 8 / radius;
      return n + n * l * stands_off * stands_off * 4 / 45 / 10'000;
    };
    double best = 1;
    while (cost(best + 1) < cost(best)) ++best;
    simplify(bow, false);
    CAPTURE(radius, best);
    CHECK(static_cast<double>(bow.size()) - 1 == Approx(best).margin(1));
  }
}

TEST_CASE("simplify: of two beads of even width that meet in a ramp each stays even, for a ramp is cut into moves") {
  VertexPath path{{0, 0, 400}, {3'000, 0, 400}, {3'200, 0, 460}, {6'000, 0, 460}};
  simplify(path, false);
  REQUIRE(path.size() == 4);
  CHECK(path[1].x == Approx(3'000).margin(20));
  CHECK(path[2].x == Approx(3'200).margin(20));
  CHECK(path[1].band == Approx(400).margin(3));
  CHECK(path[2].band == Approx(460).margin(3));
}

TEST_CASE("simplify: a path is the same from either end") {
  std::mt19937 random(8);
  for (int n = 0; n < 100; ++n) {
    VertexPath path = walk(random), back(path.rbegin(), path.rend());
    simplify(path, false);
    simplify(back, false);
    std::reverse(back.begin(), back.end());
    REQUIRE(back.size() == path.size());
    for (std::size_t i = 0; i < path.size(); ++i) {
      CHECK(length(path[i], back[i]) < 0.5);  // half of what the lattice tells
      CHECK(path[i].band == Approx(back[i].band).margin(0.5));
    }
  }
}
