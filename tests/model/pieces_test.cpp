// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/pieces.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;

namespace {

constexpr double worth_um3 = 10'000;  // of a move: a line 10 µm off at both edges along half of 0.2 mm

double distance(const PathVertex& a, const PathVertex& b) {
  return std::hypot(b.x - a.x, b.y - a.y);
}

PathVertex at(const VertexPath& path, Stop stop) {
  return stop.t > 0 ? lerp(path[stop.from], path[stop.from + 1], stop.t) : path[stop.from];
}

/// ∫ d² ds from one stop to another, d from the line that makes it least: of many lines through the middle the best,
/// of many short stretches the sum.
double misfit_um3(const VertexPath& path, Stop from, Stop to) {
  VertexPath places{at(path, from)};
  for (std::size_t i = from.from + 1; i <= to.from; ++i) places.push_back(path[i]);
  places.push_back(at(path, to));
  double length = 0, x = 0, y = 0;
  struct Bit {
    double x, y, l;
  };
  std::vector<Bit> bits;
  for (std::size_t i = 1; i < places.size(); ++i) {
    constexpr int parts = 40;
    for (int k = 0; k < parts; ++k) {
      const PathVertex p = lerp(places[i - 1], places[i], (k + 0.5) / parts);
      bits.push_back({p.x, p.y, distance(places[i - 1], places[i]) / parts});
      length += bits.back().l, x += p.x * bits.back().l, y += p.y * bits.back().l;
    }
  }
  if (length <= 0) return 0;
  x /= length, y /= length;
  const auto off = [&](double angle) {
    double sum = 0;
    for (const Bit& b : bits) {
      const double aside = (b.x - x) * std::sin(angle) - (b.y - y) * std::cos(angle);
      sum += aside * aside * b.l;
    }
    return sum;
  };
  double best = 0, step = std::numbers::pi / 16;
  for (double a = 0; a < std::numbers::pi; a += std::numbers::pi / 16)
    if (off(a) < off(best)) best = a;
  for (; step > 1e-7; step /= 2)
    for (const double a : {best - step, best + step})
      if (off(a) < off(best)) best = a;
  return off(best);
}

double cost(const VertexPath& path, const std::vector<Stop>& stops) {
  double sum = 0;
  for (std::size_t k = 1; k < stops.size(); ++k) sum += 1 + misfit_um3(path, stops[k - 1], stops[k]) / worth_um3;
  return sum;
}

/// The least cost of all ways to choose ends among the vertices, none of whose pieces is too short.
double least_cost(const VertexPath& path) {
  const std::size_t n = path.size();
  std::vector<double> piece(n * n, 1e18);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = i + 1; j < n; ++j)
      if (distance(path[i], path[j]) >= least_piece) piece[i * n + j] = cost(path, {{i, 0}, {j, 0}});
  double best = 1e18;
  for (unsigned chosen = 0; chosen < 1U << (n - 2); ++chosen) {
    double sum = 0;
    std::size_t last = 0;
    for (std::size_t i = 1; i < n; ++i)
      if (i + 1 == n || (chosen >> (i - 1) & 1U) != 0) sum += piece[last * n + i], last = i;
    best = std::min(best, sum);
  }
  return best;
}

}  // namespace

TEST_CASE("pieces: no choice of a path's vertices costs less than the pieces that are found", "[law]") {
  std::mt19937 random(11);
  const auto share = [&] { return static_cast<double>(random() % 1'000) / 1'000; };
  int fewer = 0;
  for (int n = 0; n < 80; ++n) {
    VertexPath path{{0, 0, 400}};
    double way = 0;
    const double bend = 0.1 + 0.9 * share(), step = 80 + 200 * share();
    for (int i = 0; i < 10; ++i) {
      way += bend * (2 * share() - 1);
      const double by = step * (0.5 + share());
      path.push_back({path.back().x + by * std::cos(way), path.back().y + by * std::sin(way), 400});
    }
    const auto stops = ends_of_pieces(path);
    CAPTURE(n, stops.size());
    CHECK(cost(path, stops) < least_cost(path) + 1e-3);
    fewer += stops.size() < path.size() ? 1 : 0;
  }
  CHECK(fewer > 40);  // there was something to choose
}

TEST_CASE("pieces: none is shorter than a move may be, and their ends are in order", "[law]") {
  std::mt19937 random(12);
  for (int n = 0; n < 300; ++n) {
    VertexPath path{{0, 0, 400}};
    double way = 0;
    for (int i = 0; i < 60; ++i) {
      way += (static_cast<double>(random() % 1'000) / 500 - 1) * 1.5;
      const double by = 1 + static_cast<double>(random() % 100);
      path.push_back({path.back().x + by * std::cos(way), path.back().y + by * std::sin(way),
                      300 + static_cast<double>(random() % 200)});
    }
    const auto stops = ends_of_pieces(path);
    REQUIRE(stops.size() >= 2);
    CHECK((stops.front().from == 0 && stops.front().t == 0));
    CHECK((stops.back().from + 1 == path.size() && stops.back().t == 0));
    CAPTURE(n);
    for (std::size_t k = 1; k < stops.size(); ++k) {
      const Stop &a = stops[k - 1], &b = stops[k];
      CHECK((a.from < b.from || (a.from == b.from && a.t < b.t)));
      if (stops.size() > 2) CHECK(distance(at(path, a), at(path, b)) >= least_piece - 1e-3);
    }
  }
}
