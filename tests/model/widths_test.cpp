// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/widths.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;

namespace {

constexpr double least = 500;

/// A path along X, of widths at places.
VertexPath along_x(const std::vector<std::pair<double, double>>& widths) {
  VertexPath path;
  for (const auto& [x, width] : widths) path.push_back({x, 0, width});
  return path;
}

double width_at(const VertexPath& path, double x) {
  for (std::size_t i = 1; i < path.size(); ++i)
    if (path[i].x >= x && path[i].x > path[i - 1].x)
      return lerp(path[i - 1], path[i], (x - path[i - 1].x) / (path[i].x - path[i - 1].x)).band;
  return path.back().band;
}

VertexPath mirrored(VertexPath path) {
  std::reverse(path.begin(), path.end());
  for (PathVertex& v : path) v.x = -v.x;
  return path;
}

}  // namespace

TEST_CASE("widths: what is held long enough stays as it is, steps and slopes included") {
  for (const VertexPath& path : {along_x({{0, 300}, {600, 300}, {600, 450}, {1'200, 450}, {1'200, 350}, {2'000, 350}}),
                                 along_x({{0, 400}, {1'000, 400}, {4'000, 600}, {5'000, 600}})}) {
    VertexPath steady = path;
    steady_widths(steady, false, least);
    for (const PathVertex& v : steady)
      CHECK(v.band == Approx(width_at(path, v.x)).margin(v.x == 600 || v.x == 1'200 ? 150 : 1e-9));
    CHECK(width_at(steady, 599) == Approx(width_at(path, 599)).margin(1));
    CHECK(width_at(steady, 601) == Approx(width_at(path, 601)).margin(1));
  }
}

TEST_CASE("widths: a height is cut, and a dip filled, to where it is held long enough") {
  for (const double sign : {1.0, -1.0}) {  // 200 high, and 500 long where it is 150 high
    VertexPath path = along_x({{0, 400}, {3'000, 400}, {4'000, 400 + sign * 200}, {5'000, 400}, {8'000, 400}});
    path[2].band = 400 + sign * 200;
    steady_widths(path, false, least);
    CHECK(width_at(path, 4'000) == Approx(400 + sign * 150).margin(10));
    CHECK(width_at(path, 3'500) == Approx(400 + sign * 100).margin(1));
    CHECK(width_at(path, 1'000) == 400);
    VertexPath narrow = along_x(
        {{0, 400}, {3'000, 400}, {3'000, 400 + sign * 200}, {3'490, 400 + sign * 200}, {3'490, 400}, {8'000, 400}});
    steady_widths(narrow, false, least);
    for (const PathVertex& v : narrow) CHECK(v.band == 400);
  }
}

TEST_CASE("widths: at an end half as long is enough") {
  VertexPath path = along_x({{0, 100}, {1'000, 500}, {5'000, 500}, {5'000, 700}, {5'240, 700}});
  steady_widths(path, false, least);
  CHECK(path.front().band == Approx(200).margin(12));
  CHECK(path.back().band == 500);
  VertexPath held = along_x({{0, 500}, {5'000, 500}, {5'000, 700}, {5'260, 700}});
  steady_widths(held, false, least);
  CHECK(held.back().band == 700);
}

TEST_CASE("widths: jitter keeps its mean, and a path that is too short its volume") {
  VertexPath jitter;
  for (int i = 0; i <= 400; ++i) jitter.push_back({i * 50.0, 0, i % 2 == 0 ? 390.0 : 410.0});
  steady_widths(jitter, false, least);
  for (const PathVertex& v : jitter) CHECK(v.band == Approx(400).margin(1e-9));
  VertexPath dab = along_x({{0, 200}, {300, 500}, {400, 300}});
  steady_widths(dab, false, least);
  for (const PathVertex& v : dab) CHECK(v.band == Approx((300 * 350 + 100 * 400) / 400.0));
}

TEST_CASE("widths: neither the way round nor where a circle begins matters, and no width is laid that was not there") {
  std::mt19937 random(20240601);
  for (int round = 0; round < 200; ++round) {
    VertexPath path;
    const int n = 5 + static_cast<int>(random() % 60);
    for (int i = 0; i < n; ++i) {
      const double a = 6.283185307 * i / n;
      path.push_back({2'000 * std::cos(a), 2'000 * std::sin(a), 250.0 + static_cast<double>(random() % 400)});
    }
    const auto [low, high] =
        std::minmax_element(path.begin(), path.end(), [](auto& a, auto& b) { return a.band < b.band; });
    const double narrowest = low->band, widest = high->band;
    for (const bool closed : {true, false}) {
      CAPTURE(round, closed);
      VertexPath steady = path, back = mirrored(path);
      steady_widths(steady, closed, least), steady_widths(back, closed, least);
      back = mirrored(back);
      if (closed)
        std::rotate(back.begin(), back.end() - 1, back.end()),
            std::rotate(
                back.begin(),
                std::find_if(back.begin(), back.end(),
                             [&](const PathVertex& v) { return std::hypot(v.x - path[0].x, v.y - path[0].y) < 1e-6; }),
                back.end());
      REQUIRE(steady.size() == back.size());
      double off = 0;
      for (std::size_t i = 0; i < steady.size(); ++i) off = std::max(off, std::abs(steady[i].band - back[i].band));
      CHECK(off < 1e-6);
      for (const PathVertex& v : steady) CHECK((v.band >= narrowest - 1e-9 && v.band <= widest + 1e-9));
      if (!closed) continue;
      VertexPath turned = path;
      std::rotate(turned.begin(), turned.begin() + n / 3, turned.end());
      steady_widths(turned, true, least);
      double sum = 0, sum_turned = 0;
      for (const PathVertex& v : steady) sum += v.band;
      for (const PathVertex& v : turned) sum_turned += v.band;
      CHECK(sum_turned == Approx(sum));
    }
  }
}

TEST_CASE("widths: each is the mean of both orders of cuts and fills, each to the highest level that is held") {
  constexpr double apart = 20;  // so near that no vertices are added
  // As it is said: for each vertex, the stretches around it at each level.
  const auto cut = [](const std::vector<double>& values, double sign) {
    const std::size_t n = values.size();
    std::vector<double> out = values;
    for (std::size_t i = 0; i < n; ++i) {
      double best = -1e9;
      for (const double level : values) {
        if (sign * level > sign * values[i] || sign * level < best) continue;
        std::size_t from = i, to = i;
        while (from > 0 && sign * values[from - 1] >= sign * level) --from;
        while (to + 1 < n && sign * values[to + 1] >= sign * level) ++to;
        const bool end = from == 0 || to + 1 == n;
        const double length =
            apart * (static_cast<double>(to - from + 1) - (from == 0 ? 0.5 : 0) - (to + 1 == n ? 0.5 : 0));
        if (length >= (end ? least / 2 : least)) best = sign * level;
      }
      out[i] = sign * best;
    }
    return out;
  };
  std::mt19937 random(7);
  for (int round = 0; round < 100; ++round) {
    const std::size_t n = 30 + random() % 70;
    const auto heights = 2 + random() % 40;  // few: many are equal
    std::vector<double> values;
    for (std::size_t i = 0; i < n; ++i)
      values.push_back(i > 0 && random() % 3 > 0 ? values.back() : 300.0 + static_cast<double>(random() % heights));
    VertexPath path;
    for (std::size_t i = 0; i < n; ++i) path.push_back({apart * static_cast<double>(i), 0, values[i]});
    steady_widths(path, false, least);
    REQUIRE(path.size() == n);
    if (std::all_of(values.begin(), values.end(), [&](double v) { return v == values[0]; })) continue;
    const auto low = cut(cut(values, 1), -1), high = cut(cut(values, -1), 1);
    CAPTURE(round);
    for (std::size_t i = 0; i < n; ++i) CHECK(path[i].band == (low[i] + high[i]) / 2);
  }
}
