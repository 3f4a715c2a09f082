// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/kinematics.h"

#include "core/stop.h"
#include "model/moves.h"
#include "motion/speeds.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace weft::motion {
namespace {

/// Marlin's default jerk of Z, mm/s: lifts all but stop.
constexpr double z_jerk_mm_s = 0.4;

/// Klipper's default: at least this share of a move is at cruising speed.
constexpr double min_cruise_ratio = 0.5;

double smaller_per_axis(const Move& m, double x, double y, double z) {
  double least = 1e9;
  if (m.ux != 0) least = std::min(least, x / std::abs(m.ux));
  if (m.uy != 0) least = std::min(least, y / std::abs(m.uy));
  if (m.uz != 0) least = std::min(least, z / std::abs(m.uz));
  return least;
}

/// Time of a move of the extruder alone, from rest to rest.
double extruder_s(double mm, double speed_mm_s, const MachineSettings& machine) {
  const double v = std::min(speed_mm_s, machine.machine_max_speed_e), a = machine.machine_max_acceleration_e;
  mm = std::abs(mm);
  return mm * a >= v * v ? mm / v + v / a : 2 * std::sqrt(mm / a);
}

bool uses_jerk(const MachineSettings& machine) {
  return machine.firmware != Firmware::klipper && !machine.machine_junction_deviation;
}

/// Square of the speed that a move may begin or end at beside a pause: what jerk allows at once, else rest.
double rest_speed2(const MachineSettings& machine, const Move& m) {
  if (!uses_jerk(machine) || m.length_mm == 0) return 0;
  const double v = smaller_per_axis(m, machine.machine_max_jerk, machine.machine_max_jerk, z_jerk_mm_s);
  return v * v;
}

/// By how much an axis' speed jumps in a corner, per unit of speed; where it reverses, Marlin counts the larger part
/// only.
double jump(double in, double out) {
  return in * out < 0 ? std::max(std::abs(in), std::abs(out)) : std::abs(in - out);
}

/// Square of the speed that a corner may be taken at, (mm/s)², by the machine's rule; before the moves' own speeds.
double corner_speed2(const MachineSettings& machine, const Move& in, const Move& out) {
  if (in.length_mm == 0) return rest_speed2(machine, out);
  if (out.length_mm == 0) return rest_speed2(machine, in);
  if (uses_jerk(machine)) {
    const double jerk = machine.machine_max_jerk;
    const double across =
        std::max({jump(in.ux, out.ux) / jerk, jump(in.uy, out.uy) / jerk, jump(in.uz, out.uz) / z_jerk_mm_s});
    return across > 0 ? 1 / (across * across) : 1e12;
  }
  const double cos_theta = -(in.ux * out.ux + in.uy * out.uy + in.uz * out.uz);  // of the angle between the two legs
  if (cos_theta > 0.999999) return 0;
  if (cos_theta < -0.999999) return 1e12;
  const double a = std::min(in.acceleration_mm_s2, out.acceleration_mm_s2);
  const double sin_half = std::sqrt(0.5 * (1 - cos_theta));
  const double curve = sin_half / (1 - sin_half);
  if (machine.firmware != Firmware::klipper) return a * *machine.machine_junction_deviation * curve;
  const double corner = machine.machine_max_jerk;  // v² = corner²·(√2 − 1)/a · curve · a
  const double tan_half = sin_half / std::sqrt(0.5 * (1 + cos_theta));
  return std::min(corner * corner * (std::numbers::sqrt2 - 1) * curve,
                  0.5 * std::min(in.length_mm, out.length_mm) * tan_half * a);
}

double trapezoid_s(double length, double cruise, double a, double entry2, double exit2, bool klipper) {
  const double entry = std::sqrt(entry2), exit = std::sqrt(exit2);
  double v2 = cruise * cruise;
  if (klipper)
    v2 = std::min(v2, std::max({0.5 * (entry2 + exit2) + (1 - min_cruise_ratio) * a * length, entry2, exit2}));
  const double ramps = (2 * v2 - entry2 - exit2) / (2 * a);
  if (ramps <= length) {
    const double v = std::sqrt(v2);
    return (2 * v - entry - exit) / a + (length - ramps) / v;
  }
  const double peak = std::sqrt(a * length + 0.5 * (entry2 + exit2));
  return (2 * peak - entry - exit) / a;
}

/// Collects moves, tracking where the nozzle is.
struct Collector {
  const MachineSettings& machine;
  std::vector<Move>& moves;
  std::optional<Point3> at;

  void go(Point3 to, double speed_mm_s, double acceleration_mm_s2, std::uint32_t step, bool prints) {
    if (at && *at != to) {
      const double x = (static_cast<double>(to.x) - at->x) / 1000.0, y = (static_cast<double>(to.y) - at->y) / 1000.0,
                   z = (static_cast<double>(to.z) - at->z) / 1000.0;
      Move m;
      m.length_mm = std::sqrt(x * x + y * y + z * z);
      m.ux = x / m.length_mm, m.uy = y / m.length_mm, m.uz = z / m.length_mm;
      m.speed_mm_s = std::min(speed_mm_s, smaller_per_axis(m, machine.machine_max_speed_x, machine.machine_max_speed_y,
                                                           machine.machine_max_speed_z));
      m.acceleration_mm_s2 = std::min(
          acceleration_mm_s2, smaller_per_axis(m, machine.machine_max_acceleration_x,
                                               machine.machine_max_acceleration_y, machine.machine_max_acceleration_z));
      m.step = step, m.prints = prints;
      moves.push_back(m);
    }
    at = to;
  }
  /// Moves before and after do not run into each other.
  void stand_still(std::uint32_t step) { moves.push_back({.step = step}); }
  void pause(double s, std::uint32_t step) {
    if (s > 0) moves.push_back({.pause_s = s, .step = step});
  }
};

}  // namespace

double Slowdown::of(double speed_mm_s) const {
  return std::min(speed_mm_s, most_mm_s);
}

namespace {

/// What is drawn back of the tools' filaments, mm, in the course of a layer.
class DrawnBack {
 public:
  DrawnBack(const AllRules& all, const Rules& layer) : all_(all), layer_(layer), tool_(all.loaded) {}

  const Rules& rules() const { return of_tool(all_, tool_, layer_); }
  /// @returns how far filament is drawn back now
  double draw(bool to_change) {
    const double wanted = to_mm(to_change ? rules().amount_to_change : rules().retraction.retraction_amount);
    const double more = std::max(wanted - now(), 0.0);
    now() += more;
    return more;
  }
  /// @returns how far it is pushed forward
  double push() {
    const bool changed = std::exchange(loaded_, false);
    const auto& r = rules();
    const double mm = changed
                          ? to_mm(r.amount_to_change) + to_mm(r.extra_prime_to_change)
                          : to_mm(r.retraction.retraction_amount) + to_mm(r.retraction.retraction_extra_prime_amount);
    now() = 0;
    return mm;
  }
  /// @returns seconds that it takes
  double change(ToolId tool) {
    tool_ = tool, loaded_ = true;
    return rules().tool_change_s;
  }

 private:
  double& now() { return drawn_[tool_]; }
  const AllRules& all_;
  const Rules& layer_;
  ToolId tool_;
  bool loaded_ = false;
  std::map<ToolId, double> drawn_;
};

}  // namespace

std::vector<Move> moves_of(const AllRules& all, const LayerPlan& layer, std::optional<Point3> start) {
  const Rules& rules = of_scope(all, layer.scope);
  std::size_t count = 0;
  const overloaded points_of{
      [](const Extrude& bead) { return bead.path.size(); }, [](const Travel& travel) { return travel.path.size(); },
      [](const Retract& r) { return r.wipe.size(); },       [](const Prime&) { return std::size_t{0}; },
      [](const SetFan&) { return std::size_t{0}; },         [](const ObjectStart&) { return std::size_t{0}; },
      [](const ObjectEnd&) { return std::size_t{0}; },      [](const ToolChange&) { return std::size_t{0}; },
      [](const SetTemperature&) { return std::size_t{0}; }, [](const Feed&) { return std::size_t{0}; },
      [](const Pause&) { return std::size_t{0}; }};
  for (const auto& step : layer.steps) count += 1 + std::visit(points_of, step);
  std::vector<Move> moves;
  moves.reserve(count);
  Collector out{rules.machine, moves, start};
  const double unset = rules.speeds.acceleration_print;
  DrawnBack drawn(all, rules);
  std::uint32_t i = 0;
  const overloaded add{
      [&](const Extrude& bead) {
        const double a = bead.acceleration_mm_s2 > 0 ? bead.acceleration_mm_s2 : unset;
        const bool varies = !bead.segment_speed_mm_s.empty();
        if (bead.path.size() < 2) return;
        out.go(place_of(bead, 0, layer.z), bead.speed_mm_s, a, i, true);
        for_each_move(bead.path, to_mm(bead.height), [&](const BeadMove& move) {
          const double v = varies ? static_cast<double>(bead.segment_speed_mm_s[move.piece - 1]) : bead.speed_mm_s;
          out.go(place_of(bead, move.to, layer.z), v, a, i, true);
        });
      },
      [&](const Travel& travel) {
        for (const Point3 to : travel.path)
          out.go(to, out.at ? speed_between(travel, *out.at, to) : travel.speed_mm_s,
                 travel.acceleration_mm_s2 > 0 ? travel.acceleration_mm_s2 : unset, i, false);
      },
      [&](const Retract& retract) {
        const double mm = drawn.draw(retract.to_change);
        if (mm > 0)
          out.pause(
              extruder_s(mm * retract.before_wipe, drawn.rules().retraction.retraction_retract_speed, rules.machine),
              i);
        for (const Point p : retract.wipe)
          out.go({p.x, p.y, out.at ? out.at->z : layer.z}, retract.wipe_speed_mm_s, travel_acceleration_mm_s2(rules), i,
                 false);
      },
      [&](const Prime&) {
        const auto& r = drawn.rules().retraction;
        out.pause(
            extruder_s(drawn.push(), r.retraction_prime_speed.value_or(r.retraction_retract_speed), rules.machine), i);
      },
      [&](const ToolChange& change) {
        out.stand_still(i);
        out.pause(drawn.change(change.tool), i);
      },
      [&](const SetTemperature& heat) {
        if (heat.wait) out.stand_still(i);
      },
      [&](const Feed& feed) {
        out.stand_still(i);
        out.pause(feed.seconds, i);
        if (feed.moves) out.at = Point3{feed.to.x, feed.to.y, out.at ? out.at->z : layer.z};
      },
      [&](const Pause&) { out.stand_still(i); },
      LeavesAlone<SetFan, ObjectStart, ObjectEnd>{}};
  for (; i < layer.steps.size(); ++i) std::visit(add, layer.steps[i]);
  return moves;
}

void seconds_of(const MachineSettings& machine, const std::vector<Move>& moves, const Slowdown& slowdown,
                std::vector<double>& seconds) {
  const std::size_t n = moves.size();
  seconds.assign(n, 0);
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
    entry2[i] = std::min(v * v, corner_speed2(machine, in, out));
  }
  const auto gain2 = [&](std::size_t i) {  // what acceleration adds to the square of the speed along move i
    return moves[i].length_mm > 0 ? 2 * moves[i].acceleration_mm_s2 * moves[i].length_mm : 1e18;
  };
  for (std::size_t i = n; i-- > 0;) entry2[i] = std::min(entry2[i], entry2[i + 1] + gain2(i));
  for (std::size_t i = 0; i < n; ++i) entry2[i + 1] = std::min(entry2[i + 1], entry2[i] + gain2(i));
  const bool klipper = machine.firmware == Firmware::klipper;
  for (std::size_t i = 0; i < n; ++i) {
    const auto& m = moves[i];
    seconds[i] = m.length_mm == 0
                     ? m.pause_s
                     : trapezoid_s(m.length_mm, speed[i], m.acceleration_mm_s2, entry2[i], entry2[i + 1], klipper);
  }
}

}  // namespace weft::motion
