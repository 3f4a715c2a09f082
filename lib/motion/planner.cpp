// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "motion/kinematics.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace weft::motion {
namespace {

constexpr double no_limit = 1e12;

bool uses_jerk(const MachineSettings& machine) {
  return machine.firmware != Firmware::klipper && !machine.machine_junction_deviation;
}

/// How fast the filament's speed may change at once, mm/s.
double extruder_jerk(const MachineSettings& machine) {
  return machine.machine_max_jerk_e.value_or(machine.firmware == Firmware::klipper ? 1 : 5);
}

/// How many moves the firmware knows at a time; 0: all.
int blocks_of(const MachineSettings& machine) {
  const bool all = machine.firmware == Firmware::klipper || machine.firmware == Firmware::reprapfirmware;
  return machine.machine_planner_blocks.value_or(all ? 0 : 16);
}

/// f(share of the move's speed that an axis has, in the move before and in this one, jerk of the axis).
template <class F>
void for_each_axis(const MachineSettings& machine, const Move& in, const Move& out, F f) {
  f(in.ux, out.ux, machine.machine_max_jerk);
  f(in.uy, out.uy, machine.machine_max_jerk);
  f(in.uz, out.uz, machine.machine_max_jerk_z);
  f(in.e_per_mm, out.e_per_mm, extruder_jerk(machine));
}

/// The speed that a move may begin or end at beside a pause: what jerk allows at once, else rest.
double rest_speed(const MachineSettings& machine, const Move& m, double speed) {
  if (!uses_jerk(machine) || m.length_mm == 0) return 0;
  double v = speed;
  for_each_axis(machine, m, m, [&](double share, double, double jerk) {
    if (share != 0) v = std::min(v, jerk / std::abs(share));
  });
  return v;
}

/// Where an axis reverses, Marlin counts the larger part only.
double jump(double in, double out) {
  return in * out < 0 ? std::max(std::abs(in), std::abs(out)) : std::abs(in - out);
}

/// Marlin's classic jerk. It compares the speeds that both moves have in their middle, the first at no more than the
/// second's; where each may stop and start at once at more than that gives, that holds.
double marlin_corner(const MachineSettings& machine, const Move& in, const Move& out, double v_in, double v_out) {
  const double both = std::min(v_in, v_out);
  double factor = 1;
  for_each_axis(machine, in, out, [&](double a, double b, double jerk) {
    const double jumps = jump(a * both, b * v_out) * factor;
    if (jumps > jerk) factor *= jerk / jumps;
  });
  const double v = both * factor, stop = rest_speed(machine, in, v_in), start = rest_speed(machine, out, v_out);
  constexpr double nearly = 0.99;
  return stop > nearly * v && start > nearly * v ? std::min({std::max(v, start), v_in, v_out}) : v;
}

/// RepRapFirmware: both moves meet at one speed at which no axis changes by more than its jerk.
double reprap_corner(const MachineSettings& machine, const Move& in, const Move& out) {
  double v = 1e6;
  for_each_axis(machine, in, out, [&](double a, double b, double jerk) {
    if (a != b) v = std::min(v, jerk / std::abs(a - b));
  });
  return v;
}

/// Half the angle between the two legs of a corner.
struct Corner {
  double sin_half, cos_half;
  bool straight() const { return sin_half >= 1; }
  bool back() const { return sin_half <= 0; }
  double curve() const { return sin_half / (1 - sin_half); }
};
Corner corner_of(const Move& in, const Move& out) {
  const double cos_theta = -(in.ux * out.ux + in.uy * out.uy + in.uz * out.uz);
  return {std::sqrt(std::max(0.5 * (1 - cos_theta), 0.0)), std::sqrt(std::max(0.5 * (1 + cos_theta), 0.0))};
}

double klipper_corner2(const MachineSettings& machine, const Move& in, const Move& out) {
  double v2 = no_limit;
  if (const double change = std::abs(out.e_per_mm - in.e_per_mm); change > 0)
    v2 = extruder_jerk(machine) * extruder_jerk(machine) / (change * change);
  const Corner corner = corner_of(in, out);
  if (corner.straight() || corner.cos_half <= 0) return v2;
  // Its junction deviation is reckoned from the acceleration that is asked for, and times the one that axes allow.
  const auto square_corner2 = [&](const Move& m) {
    const double allowed = m.asked_mm_s2 > 0 ? m.acceleration_mm_s2 / m.asked_mm_s2 : 1;
    return machine.machine_max_jerk * machine.machine_max_jerk * (std::numbers::sqrt2 - 1) * allowed;
  };
  const double tan_half = corner.sin_half / corner.cos_half;
  const auto within_middle2 = [&](const Move& m) { return 0.5 * m.length_mm * m.acceleration_mm_s2 * tan_half; };
  return std::min({v2, corner.curve() * square_corner2(in), corner.curve() * square_corner2(out), within_middle2(in),
                   within_middle2(out)});
}

double deviation_corner2(const MachineSettings& machine, const Move& in, const Move& out) {
  constexpr double least_sin_half = 1e-3, most_sin_half = 1 - 2.5e-7;  // beyond, it turns back, or goes straight on
  const Corner corner = corner_of(in, out);
  if (corner.sin_half < least_sin_half) return 0;
  const double sin_half = std::min(corner.sin_half, most_sin_half);
  const double a = std::min(in.acceleration_mm_s2, out.acceleration_mm_s2);
  double v2 = a * *machine.machine_junction_deviation * sin_half / (1 - sin_half);
  const double turn = std::numbers::pi - 2 * std::asin(sin_half);  // a small move of a curve that is cut into such
  constexpr double small_mm = 1, small_turn = std::numbers::pi / 4;
  if (out.length_mm < small_mm && turn < small_turn && turn > 0) v2 = std::min(v2, a * out.length_mm / turn);
  return v2;
}

/// Square of the speed that a corner may be taken at, (mm/s)², by the machine's rule.
double corner_speed2(const MachineSettings& machine, const Move& in, const Move& out, double v_in, double v_out) {
  if (in.length_mm == 0 || out.length_mm == 0) {
    const double v = in.length_mm == 0 ? rest_speed(machine, out, v_out) : rest_speed(machine, in, v_in);
    return v * v;
  }
  if (machine.firmware == Firmware::klipper) return klipper_corner2(machine, in, out);
  if (!uses_jerk(machine)) return deviation_corner2(machine, in, out);
  const double v = machine.firmware == Firmware::reprapfirmware ? reprap_corner(machine, in, out)
                                                                : marlin_corner(machine, in, out, v_in, v_out);
  return v * v;
}

/// Seconds of a move, and of them those at its highest speed.
struct Trapezoid {
  double seconds = 0, steady = 0;
};
Trapezoid trapezoid(double length, double cruise2, double a, double entry2, double exit2) {
  const double entry = std::sqrt(entry2), exit = std::sqrt(exit2);
  const double ramps = (2 * cruise2 - entry2 - exit2) / (2 * a);
  if (ramps <= length) {
    const double v = std::sqrt(cruise2), steady = (length - ramps) / v;
    return {(2 * v - entry - exit) / a + steady, steady};
  }
  const double peak = std::sqrt(a * length + 0.5 * (entry2 + exit2));
  return {(2 * peak - entry - exit) / a, 0};
}

double gain2(const Move& m) {  // what acceleration adds to the square of the speed along a move
  return 2 * m.acceleration_mm_s2 * m.length_mm;
}

/// A firmware that knows some moves ahead is never faster than what these can brake from: entry[i] belongs to move i.
void see_only(std::size_t ahead, const std::vector<Move>& moves, std::vector<double>& entry2) {
  double sum = 0;
  std::size_t end = 0, pauses = 0;  // of the moves [i, end)
  for (std::size_t i = 0; i < moves.size(); ++i) {
    for (; end < moves.size() && end < i + ahead; ++end) sum += gain2(moves[end]), pauses += moves[end].length_mm == 0;
    if (pauses == 0 && end == i + ahead) entry2[i] = std::min(entry2[i], std::max(sum, 0.0));
    sum -= gain2(moves[i]), pauses -= moves[i].length_mm == 0;
  }
}

/// Klipper's plan of moves between two rests: a second pass with less acceleration tells which of them speed up and
/// brake in turn; the peak of a run of moves that only brakes is that of the move which it follows.
class SmoothedStretch {
 public:
  SmoothedStretch(const MachineSettings& machine, std::span<const Move> moves, std::span<const double> corners2,
                  std::span<const double> speeds)
      : moves_(moves), speeds_(speeds), n_(moves.size()), start2_(n_ + 1, 0.0), smooth2_(n_ + 1, 0.0) {
    const double share = 1 - machine.machine_minimum_cruise_ratio / 100;
    std::vector<double> most2(n_ + 1, 0.0);  // smoothed
    for (std::size_t i = 1; i < n_; ++i) {
      start2_[i] = std::min(corners2[i], start2_[i - 1] + gain2(moves_[i - 1]));
      most2[i] = std::min(start2_[i], most2[i - 1] + smooth_gain2(i - 1, share));
    }
    reach2_.resize(n_), smooth_reach2_.resize(n_);
    for (std::size_t i = n_; i-- > 0;) {
      reach2_[i] = start2_[i + 1] + gain2(moves_[i]);
      start2_[i] = std::min(start2_[i], reach2_[i]);
      smooth_reach2_[i] = smooth2_[i + 1] + smooth_gain2(i, share);
      smooth2_[i] = std::min(most2[i], smooth_reach2_[i]);
      gains_more_.push_back(smooth2_[i] + smooth_gain2(i, share) > smooth2_[i + 1]);
    }
    std::reverse(gains_more_.begin(), gains_more_.end());
  }

  void times(std::span<double> seconds, std::span<double> steady) const {
    const auto take = [&](std::size_t i, double cruise2) {
      const Trapezoid t = time(i, cruise2);
      seconds[i] = t.seconds;
      if (!steady.empty()) steady[i] = t.steady;
    };
    double peak2 = 0;
    std::size_t after = n_;  // of the moves [i + 1, after) it is known that they only brake
    for (std::size_t i = n_; i-- > 0;) {
      if (smooth2_[i] >= smooth_reach2_[i]) continue;
      const bool braking = after > i + 1;
      const double v2 = speeds_[i] * speeds_[i];
      if (gains_more_[i] || braking) peak2 = std::min(v2, 0.5 * (smooth2_[i] + smooth_reach2_[i]));
      double least2 = peak2;
      for (std::size_t k = i + 1; k < after; ++k) {
        least2 = std::min(least2, start2_[k]);
        take(k, least2);
      }
      take(i, std::min({0.5 * (start2_[i] + reach2_[i]), v2, peak2}));
      after = i;
    }
  }

 private:
  double smooth_gain2(std::size_t i, double share) const {
    const Move& m = moves_[i];
    const double asked = m.asked_mm_s2 > 0 ? m.asked_mm_s2 : m.acceleration_mm_s2;
    return std::min(gain2(m), 2 * asked * share * m.length_mm);
  }
  Trapezoid time(std::size_t i, double cruise2) const {
    return trapezoid(moves_[i].length_mm, cruise2, moves_[i].acceleration_mm_s2, std::min(start2_[i], cruise2),
                     std::min(start2_[i + 1], cruise2));
  }

  std::span<const Move> moves_;
  std::span<const double> speeds_;
  std::size_t n_;
  std::vector<double> start2_, smooth2_, reach2_, smooth_reach2_;  ///< squares of speeds, by move
  std::vector<char> gains_more_;
};

void klipper_seconds(const MachineSettings& machine, const std::vector<Move>& moves, std::span<const double> corners2,
                     std::span<const double> speed, std::vector<double>& seconds, std::span<double> steady) {
  for (std::size_t begin = 0; begin < moves.size();) {
    if (moves[begin].length_mm == 0) {
      seconds[begin] = moves[begin].pause_s;
      ++begin;
      continue;
    }
    std::size_t end = begin + 1;
    while (end < moves.size() && moves[end].length_mm > 0) ++end;
    const std::size_t count = end - begin;
    const SmoothedStretch stretch(machine, std::span(moves).subspan(begin, count), corners2.subspan(begin, count),
                                  speed.subspan(begin, count));
    stretch.times(std::span(seconds).subspan(begin, count), steady.empty() ? steady : steady.subspan(begin, count));
    begin = end;
  }
}

}  // namespace

double corner_speed_mm_s(const MachineSettings& machine, const Move& in, const Move& out) {
  return std::sqrt(corner_speed2(machine, in, out, in.speed_mm_s, out.speed_mm_s));
}

void seconds_of(const MachineSettings& machine, const std::vector<Move>& moves, const Slowdown& slowdown,
                std::vector<double>& seconds, std::vector<double>* steady) {
  const std::size_t n = moves.size();
  seconds.assign(n, 0);
  if (steady != nullptr) steady->assign(n, 0);
  std::vector<double> speed(n), entry2(n + 1, 0.0);  // entry2[i]: between moves i − 1 and i
  for (std::size_t i = 0; i < n; ++i)
    speed[i] = moves[i].prints ? slowdown.of(moves[i].speed_mm_s) : moves[i].speed_mm_s;
  const Move rest;
  StopNowAndThen stop(512);
  for (std::size_t i = 0; i <= n && n > 0; ++i) {
    stop.step();
    const Move &in = i > 0 ? moves[i - 1] : rest, &out = i < n ? moves[i] : rest;
    const double v_in = in.length_mm > 0 ? speed[i - 1] : 1e9, v_out = out.length_mm > 0 ? speed[i] : 1e9;
    const double v = std::min(v_in, v_out);
    entry2[i] = std::min(v * v, corner_speed2(machine, in, out, v_in, v_out));
  }
  if (machine.firmware == Firmware::klipper)
    return klipper_seconds(machine, moves, entry2, speed, seconds, steady ? std::span(*steady) : std::span<double>());
  const auto gain = [&](std::size_t i) { return moves[i].length_mm > 0 ? gain2(moves[i]) : 1e18; };
  for (std::size_t i = n; i-- > 0;) entry2[i] = std::min(entry2[i], entry2[i + 1] + gain(i));
  if (const int blocks = blocks_of(machine); blocks > 0) see_only(static_cast<std::size_t>(blocks) - 1, moves, entry2);
  for (std::size_t i = 0; i < n; ++i) entry2[i + 1] = std::min(entry2[i + 1], entry2[i] + gain(i));
  for (std::size_t i = 0; i < n; ++i) {
    const auto& m = moves[i];
    if (m.length_mm == 0) {
      seconds[i] = m.pause_s;
      continue;
    }
    const auto t = trapezoid(m.length_mm, speed[i] * speed[i], m.acceleration_mm_s2, entry2[i], entry2[i + 1]);
    seconds[i] = t.seconds;
    if (steady != nullptr) (*steady)[i] = t.steady;
  }
}

}  // namespace weft::motion
