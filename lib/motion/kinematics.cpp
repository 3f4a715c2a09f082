// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/kinematics.h"

#include "model/moves.h"
#include "motion/arcs.h"
#include "motion/speeds.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace weft::motion {
namespace {

double smaller_per_axis(const Move& m, double x, double y, double z) {
  double least = 1e9;
  if (m.ux != 0) least = std::min(least, x / std::abs(m.ux));
  if (m.uy != 0) least = std::min(least, y / std::abs(m.uy));
  if (m.uz != 0) least = std::min(least, z / std::abs(m.uz));
  return least;
}

/// Klipper bounds the extruder where it draws back or goes alone (docs/Config_Reference, [extruder]); others always.
void bound_extruder(const MachineSettings& machine, Move& m) {
  if (m.e_per_mm == 0 || (machine.firmware == Firmware::klipper && m.e_per_mm > 0)) return;
  m.speed_mm_s = std::min(m.speed_mm_s, machine.machine_max_speed_e / std::abs(m.e_per_mm));
  m.acceleration_mm_s2 = std::min(m.acceleration_mm_s2, machine.machine_max_acceleration_e / std::abs(m.e_per_mm));
}

Way way_between(Point3 from, Point3 to) {
  return {(static_cast<double>(to.x) - from.x) / 1000.0, (static_cast<double>(to.y) - from.y) / 1000.0,
          (static_cast<double>(to.z) - from.z) / 1000.0};
}

/// Collects moves, tracking where the nozzle is.
struct Collector {
  const MachineSettings& machine;
  std::vector<Move>& moves;
  std::optional<Point3> at;

  /// @param e_mm of filament, spread evenly
  void go(Point3 to, double speed_mm_s, double acceleration_mm_s2, std::uint32_t step, bool prints, double e_mm = 0) {
    if (at && *at != to)
      if (auto m = move_along(machine, way_between(*at, to), {speed_mm_s, acceleration_mm_s2, e_mm})) {
        m->step = step, m->prints = prints;
        moves.push_back(*m);
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

std::optional<Move> move_along(const MachineSettings& machine, Way way, const Asked& asked) {
  const auto [x, y, z] = way;
  Move m;
  m.length_mm = std::sqrt(x * x + y * y + z * z);
  if (!(m.length_mm > 0)) return std::nullopt;
  m.ux = x / m.length_mm, m.uy = y / m.length_mm, m.uz = z / m.length_mm;
  m.speed_mm_s = std::min(asked.speed_mm_s, smaller_per_axis(m, machine.machine_max_speed_x,
                                                             machine.machine_max_speed_y, machine.machine_max_speed_z));
  m.acceleration_mm_s2 = std::min(asked.acceleration_mm_s2, smaller_per_axis(m, machine.machine_max_acceleration_x,
                                                                             machine.machine_max_acceleration_y,
                                                                             machine.machine_max_acceleration_z));
  m.asked_mm_s2 = asked.acceleration_mm_s2;
  m.e_per_mm = asked.e_mm / m.length_mm;
  bound_extruder(machine, m);
  return m;
}

double extruder_seconds(double mm, double speed_mm_s, const MachineSettings& machine) {
  const double v = std::min(speed_mm_s, machine.machine_max_speed_e), a = machine.machine_max_acceleration_e;
  mm = std::abs(mm);
  return mm * a >= v * v ? mm / v + v / a : 2 * std::sqrt(mm / a);
}

double Slowdown::of(double speed_mm_s) const {
  return std::min(speed_mm_s, most_mm_s);
}

namespace {

/// Filament for a volume of beads, mm a mm³.
double filament_per_mm3(const Rules& rules) {
  const double d = to_mm(rules.material.filament_diameter);
  return rules.material.material_flow / 100 / (std::numbers::pi / 4 * d * d);
}

/// What a bead is laid with.
struct Laying {
  double acceleration_mm_s2;  ///< where it has none of its own
  double e_per_mm3;
  std::uint32_t step;
  std::optional<Um> arc_segment{};
};

void add_bead(const Extrude& bead, Um z, const Laying& by, Collector& out) {
  if (bead.path.size() < 2) return;
  const double a = bead.acceleration_mm_s2 > 0 ? bead.acceleration_mm_s2 : by.acceleration_mm_s2;
  const auto speed = [&](std::size_t piece) {
    return bead.segment_speed_mm_s.empty() ? bead.speed_mm_s : static_cast<double>(bead.segment_speed_mm_s[piece - 1]);
  };
  out.go(place_of(bead, 0, z), bead.speed_mm_s, a, by.step, true);
  const auto straight = [&](const BeadMove& move) {
    out.go(place_of(bead, move.to, z), speed(move.piece), a, by.step, true, move.volume_mm3 * by.e_per_mm3);
  };
  for_each_move(bead, straight, [&](const Arc& arc, double volume_mm3) {
    const auto chords = chords_of(out.machine.firmware, by.arc_segment, bead, arc);
    const double e_mm = volume_mm3 * by.e_per_mm3 / static_cast<double>(chords.size());
    for (const Point p : chords) out.go({p.x, p.y, z}, speed(arc.last), a, by.step, true, e_mm);
  });
}

/// @param e_mm of filament along the wipe
void add_wipe(const Retract& retract, double e_mm, Um z, double acceleration_mm_s2, std::uint32_t step,
              Collector& out) {
  if (retract.wipe.empty()) return;
  const double um = (out.at ? distance(flat(*out.at), retract.wipe.front()) : 0) + length_of(retract.wipe);
  for (const Point p : retract.wipe) {
    const double share = out.at && um > 0 ? distance(flat(*out.at), p) / um : 0;
    out.go({p.x, p.y, out.at ? out.at->z : z}, retract.wipe_speed_mm_s, acceleration_mm_s2, step, false, e_mm * share);
  }
}

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

std::vector<Move> moves_of(const AllRules& all, const LayerPlan& layer, std::optional<Point3> start,
                           const MachineSettings& machine) {
  const Rules& rules = of_scope(all, layer.scope);
  std::size_t count = 0;
  const overloaded points_of{
      [](const Extrude& bead) { return bead.path.size(); }, [](const Travel& travel) { return travel.path.size(); },
      [](const Retract& r) { return r.wipe.size(); },       [](const Prime&) { return std::size_t{0}; },
      [](const SetFan&) { return std::size_t{0}; },         [](const ObjectStart&) { return std::size_t{0}; },
      [](const ObjectEnd&) { return std::size_t{0}; },      [](const ToolChange&) { return std::size_t{0}; },
      [](const SetTemperature&) { return std::size_t{0}; }, [](const Feed&) { return std::size_t{0}; },
      [](const Pause&) { return std::size_t{0}; },          [](const SetPressureAdvance&) { return std::size_t{0}; }};
  for (const auto& step : layer.steps) count += 1 + std::visit(points_of, step);
  std::vector<Move> moves;
  moves.reserve(count);
  Collector out{machine, moves, start};
  const double unset = rules.speeds.acceleration_print;
  DrawnBack drawn(all, rules);
  std::uint32_t i = 0;
  const overloaded add{
      [&](const Extrude& bead) {
        add_bead(bead, layer.z, {unset, filament_per_mm3(drawn.rules()), i, rules.arc_segment}, out);
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
              extruder_seconds(mm * retract.before_wipe, drawn.rules().retraction.retraction_retract_speed, machine),
              i);
        add_wipe(retract, -mm * (1 - retract.before_wipe), layer.z, travel_acceleration_mm_s2(rules), i, out);
      },
      [&](const Prime& prime) {
        const auto& r = drawn.rules().retraction;
        const double mm = drawn.push() + prime.extra_mm3 * filament_per_mm3(drawn.rules());
        out.pause(extruder_seconds(mm, r.retraction_prime_speed.value_or(r.retraction_retract_speed), machine), i);
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
      LeavesAlone<SetFan, ObjectStart, ObjectEnd, SetPressureAdvance>{}};
  for (; i < layer.steps.size(); ++i) std::visit(add, layer.steps[i]);
  return moves;
}

BeadMoves moves_of(const Rules& rules, const Extrude& bead) {
  BeadMoves out;
  Collector collector{rules.machine, out.moves, place_of(bead, 0, 0)};
  const double a = bead.acceleration_mm_s2 > 0 ? bead.acceleration_mm_s2 : rules.speeds.acceleration_print;
  const double e_per_mm3 = filament_per_mm3(rules);
  for_each_move(bead.path, to_mm(bead.height), [&](const BeadMove& move) {
    const double speed = bead.segment_speed_mm_s.empty() ? bead.speed_mm_s
                                                         : static_cast<double>(bead.segment_speed_mm_s[move.piece - 1]);
    const std::size_t before = out.moves.size();
    collector.go(place_of(bead, move.to, 0), speed, a, 0, true, move.volume_mm3 * e_per_mm3);
    if (out.moves.size() > before) out.ends.push_back(move.to);
  });
  return out;
}

}  // namespace weft::motion
