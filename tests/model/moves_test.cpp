// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/moves.h"

#include <numeric>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;

namespace {

constexpr double height_mm = 0.2;

std::vector<BeadMove> moves_of(const std::vector<Junction>& path) {
  std::vector<BeadMove> out;
  for_each_move(path, height_mm, [&](const BeadMove& move) { out.push_back(move); });
  return out;
}

double volume_mm3(const std::vector<Junction>& path) {
  double sum = 0;
  for (std::size_t i = 1; i < path.size(); ++i)
    sum += distance(path[i - 1].at, path[i].at) / 1000.0 * mean_area_mm2(path[i - 1], path[i], height_mm);
  return sum;
}

}  // namespace

TEST_CASE("model: a step in width is no move of its own, whichever side of it lies straight on") {
  // 10 mm at 0.45, a step over 10 µm, 0.2 mm at 0.35, and the other way round.
  const std::vector<Junction> path{{{0, 0}, 450},         {{10'000, 0}, 450},   {{10'010, 0}, 350},
                                   {{10'200, 0}, 350},    {{10'200, 200}, 350}, {{10'200, 210}, 450},
                                   {{10'200, 5'000}, 450}};
  const auto moves = moves_of(path);
  REQUIRE(moves.size() == 4);
  CHECK(moves[0].to == 1);
  CHECK(moves[1].piece == 3);  // the step lies on the way of both neighbours: the next takes it
  CHECK(moves[1].to == 3);
  CHECK(moves[2].to == 4);
  CHECK(moves[3].piece == 6);
}

TEST_CASE("model: a step that only goes straight on from the move before is part of that") {
  const std::vector<Junction> path{{{0, 0}, 450}, {{10'000, 0}, 450}, {{10'010, 0}, 350}, {{10'010, 5'000}, 350}};
  const auto moves = moves_of(path);
  REQUIRE(moves.size() == 2);
  CHECK(moves[0].piece == 1);
  CHECK(moves[0].to == 2);
  CHECK(moves[1].to == 3);
}

TEST_CASE("model: what is short but tells of a bend, a way back or an end is a move") {
  const auto count = [](const std::vector<Point>& places) {
    std::vector<Junction> path;
    for (const Point p : places) path.push_back({p, 400});
    return moves_of(path).size();
  };
  CHECK(count({{0, 0}, {5'000, 0}, {5'007, 7}, {5'007, 5'000}}) == 3);  // a corner cut off
  CHECK(count({{0, 0}, {10, 0}, {2, 0}}) == 2);                         // there and back
  CHECK(count({{0, 0}, {8, 0}}) == 1);                                  // all there is
}

TEST_CASE("model: moves end where paths end, keep to them and lay all their volume") {
  std::mt19937 random(5);
  for (int n = 0; n < 300; ++n) {
    std::vector<Junction> path{{{0, 0}, 400}};
    while (path.size() < 30) {
      const Um reach = random() % 2 == 0 ? 13 : 2'000;
      const auto some = [&] { return static_cast<Um>(random() % static_cast<unsigned>(2 * reach + 1)) - reach; };
      path.push_back(
          {path.back().at + Point{some(), random() % 3 == 0 ? 0 : some()}, 300 + static_cast<Um>(random() % 200)});
    }
    const auto moves = moves_of(path);
    REQUIRE_FALSE(moves.empty());
    CHECK(moves.back().to >= path.size() - 2);  // all but what does not move
    CHECK(path[moves.back().to].at == path.back().at);
    const double laid = std::accumulate(moves.begin(), moves.end(), 0.0,
                                        [](double sum, const BeadMove& move) { return sum + move.volume_mm3; });
    CHECK(laid == Approx(volume_mm3(path)).epsilon(1e-9));
    std::size_t from = 0;
    for (const BeadMove& move : moves) {
      const Point a = path[from].at, b = path[move.to].at;
      for (std::size_t i = from; i <= move.to; ++i) {
        const double d2 = static_cast<double>(distance2(a, b));
        const double t = d2 > 0 ? std::clamp(static_cast<double>(dot(path[i].at - a, b - a)) / d2, 0.0, 1.0) : 0;
        const Point p = path[i].at;
        CHECK(std::hypot(p.x - a.x - t * (b.x - a.x), p.y - a.y - t * (b.y - a.y)) < 3);
      }
      from = move.to;
    }
  }
}
