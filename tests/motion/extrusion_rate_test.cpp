// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/extrusion_rate.h"

#include "model/moves.h"
#include "motion/motion.h"
#include "motion/resample.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::motion;

namespace {

Extrude line(std::vector<std::pair<Um, Um>> places_and_bands, double speed_mm_s) {
  Extrude bead{.path = {}, .role = Role::inner_wall, .height = 200, .speed_mm_s = speed_mm_s};
  for (const auto& [x, band] : places_and_bands) bead.path.push_back({{x, 0}, band, 1.F});
  return bead;
}
Rules rules_with(double up, std::optional<double> down = {}) {
  Rules rules;
  rules.speeds.max_extrusion_rate_slope = up, rules.speeds.max_extrusion_rate_slope_down = down;
  rules.cooling.cool_min_speed = 0.1;
  return rules;
}
LayerPlan limited(const Rules& rules, std::vector<Step> steps) {
  LayerPlan layer{.z = 400, .height = 200, .steps = std::move(steps)};
  limit_extrusion_rate(AllRules(std::span(&rules, 1)), layer);
  return layer;
}

/// A move as a file tells it: flow and volume.
struct Told {
  double flow, volume;
};
std::vector<BeadMove> moves_of(const Extrude& bead) {
  std::vector<BeadMove> out;
  for_each_move(bead.path, 0.2, [&](const BeadMove& move) { out.push_back(move); });
  return out;
}
std::vector<Told> told(const LayerPlan& layer) {
  std::vector<Told> out;
  for (const Step& step : layer.steps)
    if (const auto* bead = std::get_if<Extrude>(&step))
      for (Point from = bead->path.front().at; const BeadMove& move : moves_of(*bead)) {
        const double speed = bead->segment_speed_mm_s.empty()
                                 ? bead->speed_mm_s
                                 : static_cast<double>(bead->segment_speed_mm_s[move.piece - 1]);
        const double mm = distance(from, bead->path[move.to].at) / 1000;
        out.push_back({move.volume_mm3 / mm * speed, move.volume_mm3});
        from = bead->path[move.to].at;
      }
  return out;
}
/// Moves that differ by less than a step of flow are one.
std::vector<Told> together(const std::vector<Told>& moves) {
  std::vector<Told> out;
  double least = 0, most = 0, seconds = 0;
  for (const Told& move : moves) {
    if (out.empty() || std::max(most, move.flow) > 1.05 * std::min(least, move.flow)) {
      out.push_back({0, 0});
      least = most = move.flow, seconds = 0;
    }
    least = std::min(least, move.flow), most = std::max(most, move.flow);
    out.back().volume += move.volume, seconds += move.volume / move.flow;
    out.back().flow = out.back().volume / seconds;
  }
  return out;
}
/// The greatest slope between the middles of moves, mm³/s²: up, and down.
std::pair<double, double> slopes(const std::vector<Told>& moves) {
  double up = 0, down = 0;
  for (std::size_t i = 1; i < moves.size(); ++i) {
    const auto &a = moves[i - 1], &b = moves[i];
    const double s = (b.flow * b.flow - a.flow * a.flow) / (a.volume + b.volume);
    up = std::max(up, s), down = std::max(down, -s);
  }
  return {up, down};
}
double seconds(const LayerPlan& layer) {
  double sum = 0;
  for (const Told& move : told(layer)) sum += move.volume / move.flow;
  return sum;
}
double volume(const LayerPlan& layer) {
  double sum = 0;
  for (const Told& move : told(layer)) sum += move.volume;
  return sum;
}

}  // namespace

TEST_CASE("extrusion rate: flow is linear in time where it changes, and takes the time that the law says") {
  // 8 mm³/s, then 2, then 8, over 40 mm each.
  const std::vector<Step> steps{line({{0, 400}, {40'000, 400}}, 100), line({{40'000, 400}, {80'000, 400}}, 25),
                                line({{80'000, 400}, {120'000, 400}}, 100)};
  for (const double slope : {10.0, 40.0, 200.0}) {
    const auto rules = rules_with(slope);
    const auto layer = limited(rules, steps);
    INFO(slope);
    const auto [up, down] = slopes(told(layer));
    CHECK(up <= 1.02 * slope);
    CHECK(down <= 1.02 * slope);
    CHECK(std::max(up, down) > 0.9 * slope);
    CHECK(volume(layer) == Approx(9.6).epsilon(1e-4));
    // A ramp from 2 to 8 takes 6/slope and lays 30/slope; without it that would have taken 30/slope/8.
    if (30 / slope < 3.2)
      CHECK(seconds(layer) == Approx(2 * 40.0 / 100 + 40.0 / 25 + 2 * (6 / slope - 30 / slope / 8)).epsilon(0.01));
    // What is slow already stays as it is: only what is faster gives way.
    for (const Told& move : told(layer)) CHECK(move.flow >= 2 - 1e-9);
  }
}

TEST_CASE("extrusion rate: how fast flow falls is a limit of its own") {
  const std::vector<Step> steps{line({{0, 400}, {40'000, 400}}, 100), line({{40'000, 400}, {80'000, 400}}, 25),
                                line({{80'000, 400}, {120'000, 400}}, 100)};
  const auto rules = rules_with(100, 20);
  const auto [up, down] = slopes(told(limited(rules, steps)));
  CHECK(up == Approx(100).epsilon(0.1));
  CHECK(down == Approx(20).epsilon(0.1));
  Rules only_down;
  only_down.speeds.max_extrusion_rate_slope_down = 20;
  const auto layer = limited(only_down, steps);
  CHECK(slopes(told(layer)).second <= 1.02 * 20);
  const auto& last = std::get<Extrude>(layer.steps[2]);  // it grows at once
  CHECK(last.segment_speed_mm_s.empty());
  CHECK(last.speed_mm_s == 100);
}

TEST_CASE("extrusion rate: widths that change, and pieces shorter than a ramp") {
  auto bead = line({{0, 300}, {10'000, 300}, {10'400, 900}, {30'000, 900}, {30'200, 200}, {60'000, 200}}, 100);
  cut_where_width_changes(bead.path);
  Extrude fine = line({}, 60);
  for (Um x = 60'000; x <= 70'000; x += 100) fine.path.push_back({{x, x % 300 == 0 ? 20 : 0}, 400 + x % 200 / 10, 1.F});
  for (const double slope : {5.0, 20.0, 80.0}) {
    const auto rules = rules_with(slope);
    const auto layer = limited(rules, {bead, fine});
    const auto [up, down] = slopes(together(told(layer)));
    INFO(slope << ": " << up << ", " << down);
    CHECK(up <= 1.02 * slope);
    CHECK(down <= 1.02 * slope);
  }
}

TEST_CASE("extrusion rate: short pieces of very different widths keep the law in the moves that are written") {
  Extrude rough = line({{0, 400}}, 120);
  std::uint32_t seed = 7;
  const auto next = [&](Um least, Um most) {
    seed = seed * 1664525U + 1013904223U;
    return least + static_cast<Um>((seed >> 8) % static_cast<std::uint32_t>(most - least));
  };
  for (int i = 0; i < 400; ++i)
    rough.path.push_back({{rough.path.back().at.x + next(20, 300), 0}, next(250, 600), 1.F});
  cut_where_width_changes(rough.path);
  const double before = volume({.height = 200, .steps = {rough}});
  for (const double slope : {20.0, 80.0, 300.0}) {
    const auto rules = rules_with(slope);
    const auto layer = limited(rules, {rough});
    const auto [up, down] = slopes(together(told(layer)));
    INFO(slope << ": " << up << ", " << down);
    CHECK(up <= 1.1 * slope);  // of what is one flow, and what the lattice rounds
    CHECK(down <= 1.1 * slope);
    CHECK(volume(layer) == Approx(before).epsilon(1e-3));
  }
}

TEST_CASE("extrusion rate: a short way without a retraction goes on, a long one and a retraction do not") {
  const auto slow = line({{0, 400}, {40'000, 400}}, 25);
  const auto fast_after = [&](Um way) { return line({{40'000 + way, 400}, {80'000 + way, 400}}, 100); };
  const auto rules = rules_with(20);
  const auto speed_after = [&](std::vector<Step> between, Um way) {
    std::vector<Step> steps{slow};
    steps.insert(steps.end(), between.begin(), between.end());
    steps.emplace_back(fast_after(way));
    const auto layer = limited(rules, std::move(steps));
    const auto& bead = std::get<Extrude>(layer.steps.back());
    return bead.segment_speed_mm_s.empty() ? bead.speed_mm_s : static_cast<double>(bead.segment_speed_mm_s.front());
  };
  const auto to = [](Um way) { return Travel{{Point3{40'000 + way, 0, 400}}}; };
  CHECK(speed_after({to(2'000)}, 2'000) < 40);
  CHECK(speed_after({to(4'000)}, 4'000) == 100);
  CHECK(speed_after({Retract{}, to(1'000), Prime{}}, 1'000) == 100);
}

TEST_CASE("extrusion rate: off, nothing is touched") {
  const Rules rules;
  const auto bead = line({{0, 400}, {40'000, 900}}, 100);
  LayerPlan layer{.z = 400, .height = 200, .steps = {bead}};
  CHECK_FALSE(limits_extrusion_rate(AllRules(std::span(&rules, 1)), layer));
  limit_extrusion_rate(AllRules(std::span(&rules, 1)), layer);
  CHECK(std::get<Extrude>(layer.steps[0]).path == bead.path);
  CHECK(std::get<Extrude>(layer.steps[0]).speed_mm_s == 100);
}
