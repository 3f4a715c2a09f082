// SPDX-License-Identifier: GPL-3.0-or-later
// The estimate of time beside simulators that are written from the firmwares' documents and share nothing with it but
// the list of moves: Klipper's docs/Kinematics.md and Config_Reference.md, Marlin's page on configuring motion.
#include "motion/kinematics.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <numbers>
#include <numeric>
#include <random>

#include <catch2/catch.hpp>

using namespace weft;
using namespace weft::motion;

namespace {

Move move_by(double x, double y, double speed, double acceleration, double e_per_mm = 0.033) {
  Move m;
  m.length_mm = std::hypot(x, y);
  m.ux = x / m.length_mm, m.uy = y / m.length_mm;
  m.speed_mm_s = speed, m.acceleration_mm_s2 = m.asked_mm_s2 = acceleration;
  m.e_per_mm = e_per_mm, m.prints = true;
  return m;
}

/// Moves as a layer has them: long lines, curves of small pieces, zigzags, travels, changes of flow.
std::vector<Move> like_a_layer(unsigned seed, double acceleration) {
  std::mt19937 random(seed);
  const auto pick = [&](double least, double most) {
    return least + (most - least) * static_cast<double>(random() % 10007) / 10007;
  };
  std::vector<Move> out;
  double heading = 0;
  for (int part = 0; part < 60; ++part) {
    const double speed = pick(20, 200), e = pick(0.02, 0.05);
    const int kind = static_cast<int>(random() % 4);
    const int count = kind == 0 ? 1 : kind == 1 ? 60 : kind == 2 ? 20 : 4;
    for (int i = 0; i < count; ++i) {
      const double length = kind == 0   ? pick(5, 60)
                            : kind == 1 ? pick(0.1, 0.6)
                            : kind == 2 ? pick(0.3, 6)
                                        : pick(1, 9);
      heading += kind == 1 ? pick(-0.15, 0.25) : kind == 2 ? (i % 2 == 0 ? 1.6 : -1.6) : pick(-2.5, 2.5);
      out.push_back(
          move_by(length * std::cos(heading), length * std::sin(heading), speed, acceleration, kind == 3 ? 0 : e));
    }
  }
  return out;
}

double planned_s(const MachineSettings& machine, const std::vector<Move>& moves) {
  std::vector<double> seconds;
  seconds_of(machine, moves, {}, seconds);
  return std::accumulate(seconds.begin(), seconds.end(), 0.0);
}

/// Walks along all moves in steps of `step` and asks at each how fast it may be: v² grows and falls by 2a a mm.
/// @param corner2 of v² between moves i − 1 and i
double walked_s(const std::vector<Move>& moves, const std::vector<double>& corner2, double step) {
  std::vector<double> most2{0}, gain{};
  std::vector<double> lengths{};
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const int cells = std::max(1, static_cast<int>(std::ceil(moves[i].length_mm / step)));
    const double v2 = moves[i].speed_mm_s * moves[i].speed_mm_s;
    most2.back() = std::min(most2.back(), i > 0 ? std::min(corner2[i], v2) : 0.0);
    for (int c = 0; c < cells; ++c) {
      lengths.push_back(moves[i].length_mm / cells);
      gain.push_back(2 * moves[i].acceleration_mm_s2 * lengths.back());
      most2.push_back(v2);
    }
  }
  most2.back() = 0;
  for (std::size_t i = gain.size(); i-- > 0;) most2[i] = std::min(most2[i], most2[i + 1] + gain[i]);
  double s = 0;
  for (std::size_t i = 0; i < gain.size(); ++i) {
    most2[i + 1] = std::min(most2[i + 1], most2[i] + gain[i]);
    const double v = 0.5 * (std::sqrt(most2[i]) + std::sqrt(most2[i + 1]));
    s += v > 0 ? lengths[i] / v : std::sqrt(4 * lengths[i] / (gain[i] / (2 * lengths[i])));  // up and down in a cell
  }
  return s;
}

double angle_between(const Move& a, const Move& b) {  // of the two legs of the corner: π goes straight on
  return std::numbers::pi - std::acos(std::clamp(a.ux * b.ux + a.uy * b.uy + a.uz * b.uz, -1.0, 1.0));
}

/// docs/Kinematics.md, "Junction speed"; Config_Reference, instantaneous_corner_velocity.
std::vector<double> klipper_corners2(const std::vector<Move>& moves, double square_corner, double instant_e) {
  std::vector<double> out(moves.size() + 1, 0.0);
  for (std::size_t i = 1; i < moves.size(); ++i) {
    const Move &a = moves[i - 1], &b = moves[i];
    const double theta = angle_between(a, b), sin_half = std::sin(theta / 2), cos_half = std::cos(theta / 2);
    double v2 = 1e12;
    if (const double change = b.e_per_mm - a.e_per_mm; change != 0) v2 = std::pow(instant_e / change, 2);
    if (1 - sin_half > 1e-12 && cos_half > 1e-9) {
      const double delta = square_corner * square_corner * (std::sqrt(2.0) - 1) / b.acceleration_mm_s2;
      const double radius = delta * sin_half / (1 - sin_half);
      v2 = std::min(v2, b.acceleration_mm_s2 * radius);
      for (const Move* m : {&a, &b}) v2 = std::min(v2, m->acceleration_mm_s2 * m->length_mm / 2 * std::tan(theta / 2));
    }
    out[i] = v2;
  }
  return out;
}

/// Marlin, classic jerk: what two moves may meet at.
double marlin_junction(const Move& a, const Move& b, double jerk_xy, double jerk_e) {
  const double slow = std::min(a.speed_mm_s, b.speed_mm_s);
  double v = slow;
  const std::array jerks{jerk_xy, jerk_xy, jerk_e};
  const std::array out{a.ux * slow, a.uy * slow, a.e_per_mm * slow};
  const std::array in{b.ux * b.speed_mm_s, b.uy * b.speed_mm_s, b.e_per_mm * b.speed_mm_s};
  double least = 1;
  for (std::size_t i = 0; i < jerks.size(); ++i) {
    const bool turns = (out[i] > 0 && in[i] < 0) || (out[i] < 0 && in[i] > 0);
    const double jumps = turns ? std::max(std::abs(out[i]), std::abs(in[i])) : std::abs(out[i] - in[i]);
    if (jumps > 0) least = std::min(least, jerks[i] / jumps);
  }
  return v * least;
}
double marlin_rest(const Move& m, double jerk_xy, double jerk_e) {
  double v = m.speed_mm_s;
  for (const auto& [share, jerk] : {std::pair{m.ux, jerk_xy}, {m.uy, jerk_xy}, {m.e_per_mm, jerk_e}})
    if (share != 0) v = std::min(v, jerk / std::abs(share));
  return v;
}

/// A ring of blocks that is planned again whenever a move has come in: each ends as slowly as what is known asks for.
double marlin_blocks_s(const std::vector<Move>& moves, std::size_t blocks, double jerk_xy, double jerk_e) {
  double s = 0, entry2 = std::pow(marlin_rest(moves[0], jerk_xy, jerk_e), 2);
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const std::size_t last = std::min(moves.size(), i + blocks) - 1;  // in the ring with move i
    double exit2 = last + 1 == moves.size() ? std::pow(marlin_rest(moves[last], jerk_xy, jerk_e), 2) : 0;
    for (std::size_t k = last; k > i; --k) {
      const double a = moves[k].acceleration_mm_s2, start = marlin_rest(moves[k], jerk_xy, jerk_e),
                   stop = marlin_rest(moves[k - 1], jerk_xy, jerk_e);
      double v = marlin_junction(moves[k - 1], moves[k], jerk_xy, jerk_e);
      if (stop > 0.99 * v && start > 0.99 * v) v = std::min(start, moves[k - 1].speed_mm_s);
      exit2 = std::min(v * v, exit2 + 2 * a * moves[k].length_mm);
    }
    const Move& m = moves[i];
    const double a = m.acceleration_mm_s2, L = m.length_mm;
    exit2 = std::min({exit2, entry2 + 2 * a * L, m.speed_mm_s * m.speed_mm_s});
    const double peak = std::min(m.speed_mm_s, std::sqrt(std::max(entry2, exit2) == entry2 && entry2 - exit2 > 2 * a * L
                                                             ? entry2
                                                             : 0.5 * (entry2 + exit2) + a * L));
    const double up = (peak * peak - entry2) / (2 * a), down = (peak * peak - exit2) / (2 * a);
    s += (peak - std::sqrt(entry2)) / a + (peak - std::sqrt(exit2)) / a + std::max(0.0, L - up - down) / peak;
    entry2 = exit2;
  }
  return s;
}

MachineSettings machine_with(Firmware firmware) {
  MachineSettings machine;
  machine.firmware = firmware;
  machine.machine_max_jerk = firmware == Firmware::klipper ? 5 : 8;
  return machine;
}

}  // namespace

TEST_CASE("motion: Klipper's look-ahead is what its documents say, walked along in small steps") {
  auto machine = machine_with(Firmware::klipper);
  machine.machine_minimum_cruise_ratio = 0;
  for (const unsigned seed : {1U, 2U, 3U}) {
    const auto moves = like_a_layer(seed, 3000);
    const double walked = walked_s(moves, klipper_corners2(moves, 5, 1), 0.002);
    CHECK(planned_s(machine, moves) == Approx(walked).epsilon(1e-3));  // a thousandth: of the steps of 2 µm
  }
}

TEST_CASE("motion: the minimum cruise ratio holds moves, and runs of moves, below the peak they might reach") {
  auto machine = machine_with(Firmware::klipper);
  // From rest to rest over L: with a ratio r speed² stays below (1 − r)·a·L.
  for (const double ratio : {0.0, 50.0, 80.0}) {
    machine.machine_minimum_cruise_ratio = ratio;
    const double a = 1000, length = 10, v = std::sqrt((1 - ratio / 100) * a * length);
    const double expected = 2 * v / a + (length - v * v / a) / v;
    CHECK(planned_s(machine, {move_by(length, 0, 500, a)}) == Approx(expected));
    // In one piece or in four.
    const std::vector<Move> pieces(4, move_by(length / 4, 0, 500, a));
    CHECK(planned_s(machine, pieces) == Approx(expected));
  }
  // What comes into a turn fast, and is fast behind it, need not slow down for the ratio.
  machine.machine_minimum_cruise_ratio = 50;
  std::vector<Move> line(200, move_by(1, 0, 100, 1000));
  const double all = planned_s(machine, line);
  machine.machine_minimum_cruise_ratio = 0;
  CHECK(planned_s(machine, line) == Approx(all));
}

TEST_CASE("motion: with Klipper a change of flow along a straight line is passed at the extruder's corner velocity") {
  auto machine = machine_with(Firmware::klipper);
  machine.machine_minimum_cruise_ratio = 0;
  const std::vector<Move> moves{move_by(50, 0, 100, 1000, 0.03), move_by(50, 0, 100, 1000, 0.08)};
  const auto ramp = [](double v) {
    return 100.0 / 1000 + (50 - 100.0 * 100 / 2000 - (1e4 - v * v) / 2000) / 100 + (100 - v) / 1000;
  };
  CHECK(planned_s(machine, moves) == Approx(2 * ramp(1 / 0.05)));
  machine.machine_max_jerk_e = 2;
  CHECK(planned_s(machine, moves) == Approx(2 * ramp(2 / 0.05)));
}

TEST_CASE("motion: Marlin's ring of blocks is planned as if each move that comes in were the last") {
  const auto machine = machine_with(Firmware::marlin2);
  for (const unsigned seed : {1U, 2U, 3U}) {
    const auto moves = like_a_layer(seed, 1500);
    const double simulated = marlin_blocks_s(moves, 16, 8, 5);
    CHECK(planned_s(machine, moves) == Approx(simulated).epsilon(0.01));  // the goal; what it really is stands below
    CHECK(planned_s(machine, moves) == Approx(simulated).epsilon(1e-6));
  }
}

TEST_CASE("motion: few blocks of small moves are slow, and more of them are faster") {
  auto machine = machine_with(Firmware::marlin2);
  const std::vector<Move> moves(2000, move_by(0.2, 0, 150, 1500));
  // 15 moves of 0.2 mm: 95 mm/s.
  CHECK(planned_s(machine, moves) == Approx(400 / std::sqrt(2 * 1500 * 15 * 0.2)).epsilon(0.01));
  machine.machine_planner_blocks = 64;
  CHECK(planned_s(machine, moves) == Approx(400 / 150.0).epsilon(0.05));
}

TEST_CASE("motion: jerk of Z and of the filament bound corners, but for Klipper's") {
  auto machine = machine_with(Firmware::marlin2);
  std::vector<Move> moves{move_by(20, 0, 60, 1000, 0), move_by(20, 0, 60, 1000, 0.5)};
  const double at_5 = planned_s(machine, moves);
  machine.machine_max_jerk_e = 50;
  CHECK(planned_s(machine, moves) < at_5);
  std::vector<Move> lift{move_by(20, 0, 60, 1000, 0), move_by(20, 0, 60, 1000, 0)};
  lift[1].ux = 0.8, lift[1].uz = 0.6;
  const double low = planned_s(machine, lift);
  machine.machine_max_jerk_z = 20;
  CHECK(planned_s(machine, lift) < low);
}
