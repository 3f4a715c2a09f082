// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/motion.h"

#include "core/stop.h"
#include "model/flow.h"
#include "motion/arcs.h"
#include "motion/cooling.h"
#include "motion/extrusion_rate.h"
#include "motion/fan_lead.h"
#include "motion/kinematics.h"
#include "motion/pressure_advance.h"
#include "motion/speeds.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace weft::motion {
namespace {

/// @param goes_on the wall before it: both are pieces of one
/// @returns its volume, mm³
double count_bead(const Extrude& bead, bool goes_on, Statistics& s) {
  auto& feature = s.features[static_cast<std::size_t>(bead.role)];
  const bool wall = is_wall(bead.role);
  const double height_mm = to_mm(bead.height);
  double mm = 0, mm3 = 0;
  if (wall && !goes_on) ++s.walls.beads;
  for (std::size_t i = 1; i < bead.path.size(); ++i) {
    const auto &a = bead.path[i - 1], &b = bead.path[i];
    const double length = distance(a.at, b.at) / 1000.0;
    mm += length;
    mm3 += length * mean_area_mm2(a, b, height_mm);
    if (!wall) continue;
    if (a.width != b.width) s.walls.variable_width_mm += length;
    if (a.flow < 1.F || b.flow < 1.F) s.walls.flow_compensated_mm += length;
  }
  if (wall)
    for (const auto& j : bead.path) {
      s.walls.min_flow_ratio = std::min(s.walls.min_flow_ratio, static_cast<double>(j.flow));
      s.walls.min_width = std::min(s.walls.min_width, flow::line_width(j.width, bead.height));
    }
  for (const Arc& arc : bead.arcs) {
    ++s.arcs.count;
    s.arcs.pieces += arc.last - arc.first;
    s.arcs.worst_um = std::max(s.arcs.worst_um, deviation_um(bead, arc));
  }
  if (wall && bead.air_quarters > 0) s.walls.over_air_mm.at(bead.air_quarters - 1U) += mm;
  if (bead.role == Role::overhang_wall) s.walls.whole_over_air_mm += mm;
  feature.mm += mm;
  feature.mm3 += mm3;
  return mm3;
}

void count_travel(const Travel& travel, std::optional<Point3> from, Statistics& s) {
  ++s.travel.moves;
  if (travel.crosses_wall) ++s.travel.wall_crossings;
  for (const Point3 to : travel.path) {
    if (from) s.travel.mm += std::hypot(to.x - from->x, to.y - from->y, to.z - from->z) / 1000.0;
    from = to;
  }
}

void count_times(const LayerPlan& layer, ToolId loaded, const std::vector<Move>& moves,
                 const std::vector<double>& seconds, Statistics& s) {
  double total = 0, of_the_user = 0;
  const overloaded spent_on{
      [&](const Extrude& bead) { return &s.features[static_cast<std::size_t>(bead.role)].s; },
      [&](const Travel&) { return &s.travel.s; },
      [&](const Retract&) { return &s.travel.retraction_s; },
      [&](const Prime&) { return &s.travel.retraction_s; },
      [&](const ToolChange&) { return &s.travel.retraction_s; },
      [&](const Feed&) { return &s.travel.retraction_s; },
      // These take no move, and what they wait for nobody knows.
      [&](const SetFan&) { return &of_the_user; },
      [&](const SetPressureAdvance&) { return &of_the_user; },
      [&](const ObjectStart&) { return &of_the_user; },
      [&](const ObjectEnd&) { return &of_the_user; },
      [&](const SetTemperature&) { return &of_the_user; },
      [&](const Pause&) { return &of_the_user; },
  };
  std::size_t step = 0;  // up to which changes of the tool are known
  for (std::size_t i = 0; i < moves.size(); ++i) {
    *std::visit(spent_on, layer.steps[moves[i].step]) += seconds[i];
    total += seconds[i];
    for (; step <= moves[i].step && !s.tools.empty(); ++step)
      if (const auto* change = std::get_if<ToolChange>(&layer.steps[step])) loaded = change->tool;
    if (!s.tools.empty() && loaded != any_tool) s.tool(loaded).s += seconds[i];
  }
  s.layer_s.push_back(total);
  s.print_time_s = total;
}

/// How long each step takes. Pre: no fan is set yet.
std::vector<float> step_seconds(const LayerPlan& layer, const std::vector<Move>& moves,
                                const std::vector<double>& seconds) {
  std::vector<float> out(layer.steps.size());
  for (std::size_t i = 0; i < moves.size(); ++i) out[moves[i].step] += static_cast<float>(seconds[i]);
  return out;
}

/// Steps that set the fan have come between the others, and take no time.
void add_fans(const LayerPlan& layer, std::vector<float>& step_s) {
  std::vector<float> out;
  out.reserve(layer.steps.size());
  std::size_t next = 0;
  for (const auto& step : layer.steps) out.push_back(std::holds_alternative<SetFan>(step) ? 0.F : step_s[next++]);
  step_s = std::move(out);
}

/// Curves are told as arcs, as far as the settings of each bead ask for it.
void tell_arcs(const AllRules& all, LayerPlan& layer) {
  const auto& own = of_scope(all, layer.scope);
  const Box room = own.arc_tolerance ? box_of(reach_area(own.machine)).grown(-2 * *own.arc_tolerance) : Box{};
  StopNowAndThen stop(16);
  for (Step& step : layer.steps) {
    auto* bead = std::get_if<Extrude>(&step);
    if (bead == nullptr || bead->path.size() < 2) continue;
    stop.step();
    const Rules& rules = of_scope(all, bead->scope);
    if (rules.arc_tolerance) fit_arcs({*rules.arc_tolerance, room, rules.machine.firmware, rules.arc_segment}, *bead);
  }
}

double area_of(const Rules& rules) {
  const double diameter_mm = to_mm(rules.material.filament_diameter);
  return std::numbers::pi / 4 * diameter_mm * diameter_mm;
}

/// What pushing the filament forward adds to a tool's beads.
struct Primes {
  std::int64_t usual = 0, after_change = 0;
};

/// What each tool takes: what is pushed forward beside its beads.
void count_tools(const AllRules& all, const Rules& layer, const std::vector<Primes>& primes, Statistics& s) {
  for (std::size_t i = 0; i < s.tools.size(); ++i) {
    auto& tool = s.tools[i];
    const Rules& rules = of_tool(all, static_cast<ToolId>(i), layer);
    const double area_mm2 = area_of(rules), flow = rules.material.material_flow / 100.0;
    tool.filament_mm3 *= flow, tool.tower_mm3 *= flow;
    if (i < primes.size())
      tool.filament_mm3 +=
          area_mm2 * (static_cast<double>(primes[i].usual) * to_mm(rules.retraction.retraction_extra_prime_amount) +
                      static_cast<double>(primes[i].after_change) * to_mm(rules.extra_prime_to_change));
    tool.filament_mm = tool.filament_mm3 / area_mm2;
    tool.filament_g = tool.filament_mm3 * rules.material.material_density / 1000.0;
  }
  if (all.tools.empty()) return;
  s.filament_mm = s.filament_mm3 = s.filament_g = 0;  // each tool has a filament of its own
  for (const auto& tool : s.tools)
    s.filament_mm += tool.filament_mm, s.filament_mm3 += tool.filament_mm3, s.filament_g += tool.filament_g;
}

/// What is pushed forward beside what was drawn back: it left the nozzle while it ironed.
void count_extra(const Prime& prime, ToolId loaded, Statistics& s) {
  s.features[static_cast<std::size_t>(Role::ironing)].mm3 += prime.extra_mm3;
  if (loaded != any_tool) s.tool(loaded).filament_mm3 += prime.extra_mm3;
}

Statistics count(const AllRules& all, const Rules& rules, const LayerPlan& layer, std::optional<Point3> at) {
  Statistics s;
  std::int64_t primes = 0;
  std::vector<Primes> tool_primes;
  ToolId loaded = all.loaded;
  bool changed = false;
  const auto prime = [&] {
    ++primes;
    if (loaded == any_tool) return;
    tool_primes.resize(std::max<std::size_t>(tool_primes.size(), loaded + std::size_t{1}));
    ++(std::exchange(changed, false) ? tool_primes[loaded].after_change : tool_primes[loaded].usual);
  };
  bool after_wall = false;
  const overloaded count_step{[&](const Extrude& bead) {
                                const double mm3 = count_bead(bead, after_wall, s);
                                after_wall = is_wall(bead.role);
                                if (bead.tool != any_tool) loaded = bead.tool;
                                if (loaded != any_tool) s.tool(loaded).filament_mm3 += mm3;
                                if (loaded != any_tool && bead.role == Role::wipe_tower)
                                  s.tool(loaded).tower_mm3 += mm3;
                                at = place_of(bead, bead.path.size() - 1, layer.z);
                              },
                              [&](const Travel& travel) {
                                count_travel(travel, at, s);
                                after_wall = false;
                                at = travel.path.back();
                              },
                              [&](const Retract& retract) {
                                ++s.travel.retractions;
                                if (!retract.wipe.empty())
                                  at = Point3{retract.wipe.back().x, retract.wipe.back().y, at ? at->z : layer.z};
                              },
                              [&](const Prime& p) { prime(), count_extra(p, loaded, s); },
                              [&](const ToolChange& change) {
                                ++s.tool(loaded = change.tool).changes;
                                changed = true;
                              },
                              [&](const Feed& feed) {
                                if (!feed.moves) return;
                                const double mm3 = feed.mm * area_of(of_tool(all, loaded, rules));
                                s.features[static_cast<std::size_t>(Role::wipe_tower)].mm3 += mm3;
                                if (loaded != any_tool)
                                  s.tool(loaded).filament_mm3 += mm3, s.tool(loaded).tower_mm3 += mm3;
                                at = Point3{feed.to.x, feed.to.y, at ? at->z : layer.z};
                              },
                              LeavesAlone<SetFan, ObjectStart, ObjectEnd, SetTemperature, Pause, SetPressureAdvance>{}};
  StopNowAndThen stop(64);
  for (const auto& step : layer.steps) {
    stop.step();
    std::visit(count_step, step);
  }
  const double area_mm2 = area_of(rules);
  for (const auto& f : s.features) s.filament_mm3 += f.mm3 * rules.material.material_flow / 100.0;
  s.filament_mm3 += static_cast<double>(primes) * to_mm(rules.retraction.retraction_extra_prime_amount) * area_mm2;
  s.filament_mm = s.filament_mm3 / area_mm2;
  s.filament_g = s.filament_mm3 * rules.material.material_density / 1000.0;
  count_tools(all, rules, tool_primes, s);
  return s;
}

}  // namespace

Rules rules_of(const Settings& s, const Settings* above) {
  const auto& usual = above ? *above : s;
  return {s.machine,
          s.material,
          s.layers,
          usual.walls,
          s.retraction,
          s.speeds,
          s.cooling,
          usual.speeds.speed_travel,
          s.tools.tool_change_time,
          s.tools.switch_extruder_retraction_amount,
          s.tools.switch_extruder_extra_prime_amount,
          s.gcode.arc_fitting ? std::optional(s.gcode.arc_tolerance) : std::nullopt,
          in_silent_mode(s.machine),
          s.gcode.arc_segment_length,
          usual.infill.infill_line_width};
}

namespace {

/// The moves of a layer and the seconds that each takes, slowed down for it to cool; its speeds are what they are then.
struct Timed {
  std::vector<Move> moves;
  std::vector<double> seconds;
  double sum() const { return std::accumulate(seconds.begin(), seconds.end(), 0.0); }
};

/// @param machine that plans it; null: that of the layer
Timed timed(const AllRules& all, const LayerPlan& layer, std::optional<Point3> start,
            const MachineSettings* machine = nullptr) {
  if (machine == nullptr) machine = &of_scope(all, layer.scope).machine;
  Timed out{moves_of(all, layer, start, *machine), {}};
  seconds_of(*machine, out.moves, {}, out.seconds);
  return out;
}

Timed cooled(const AllRules& all, LayerPlan& layer, std::optional<Point3> start) {
  const Rules& rules = of_scope(all, layer.scope);
  Timed out = timed(all, layer, start);
  const auto slowdown = slowdown_for(rules, out.moves, out.sum(), times_laid(layer));
  if (slowdown.slows()) {
    slow_down(layer, slowdown);
    seconds_of(rules.machine, out.moves, slowdown, out.seconds);
  }
  return out;
}

/// What is told between the steps: fan, and pressure advance.
void tell_between(const AllRules& all, const Timed& time, LayerPlan& layer, std::vector<float>& step_s) {
  const Rules& rules = of_scope(all, layer.scope);
  const double lead_s = rules.cooling.cool_fan_lead;
  const bool tells_pressure = tells_pressure_advance(all, layer);
  if (!all.tools.empty() || lead_s > 0 || tells_pressure) step_s = step_seconds(layer, time.moves, time.seconds);
  if (tells_pressure) {
    TimedSteps steps{layer.steps, std::move(step_s)};
    tell_pressure_advance(all, layer, time.moves, time.seconds, steps);
    layer.steps = std::move(steps.steps), step_s = std::move(steps.seconds);
  }
  set_fan(rules.cooling, layer, time.sum() / static_cast<double>(times_laid(layer)));
  if (!step_s.empty()) add_fans(layer, step_s);
  if (lead_s > 0) {
    TimedSteps steps{std::move(layer.steps), std::move(step_s)};
    lead_fan(lead_s, steps);
    layer.steps = std::move(steps.steps), step_s = std::move(steps.seconds);
  }
  if (all.tools.empty()) step_s.clear();
}

}  // namespace

PlannedLayer plan_layer(AllRules all, LayerPlan layer, std::optional<Point3> start) {
  set_speeds(all, layer, start);
  const bool even_rate = limits_extrusion_rate(all, layer);
  if (!even_rate) tell_arcs(all, layer);
  Timed time = cooled(all, layer, start);
  if (even_rate) {
    limit_extrusion_rate(all, layer);
    tell_arcs(all, layer);
    time = timed(all, layer, start);
  }
  PlannedLayer out;
  out.statistics = count(all, of_scope(all, layer.scope), layer, start);
  count_times(layer, all.loaded, time.moves, time.seconds, out.statistics);
  if (const auto& silent = of_scope(all, layer.scope).silent)
    out.statistics.silent_layer_s.push_back(timed(all, layer, start, &*silent).sum());
  tell_between(all, time, layer, out.step_s);
  out.plan = std::move(layer);
  return out;
}

std::optional<Point3> start_after(const LayerPlan& layer, std::optional<Point3> start) {
  constexpr Point3 nowhere{-max_coord - 1, -max_coord - 1, -max_coord - 1};
  const auto end = end_of(layer, start.value_or(nowhere));
  return end != nowhere ? end : start;
}

std::vector<std::optional<Point3>> starts_of(const PrintPlan& print) {
  std::vector<std::optional<Point3>> starts;
  starts.reserve(print.layers.size());
  std::optional<Point3> at;
  for (const auto& layer : print.layers) {
    starts.push_back(at);
    at = start_after(layer, at);
  }
  return starts;
}

Planned plan(AllRules rules, PrintPlan print) {
  Planned out;
  const auto starts = starts_of(print);
  for (std::size_t i = 0; i < print.layers.size(); ++i) {
    auto planned = plan_layer(rules, std::move(print.layers[i]), starts[i]);
    print.layers[i] = std::move(planned.plan);
    out.statistics.append(planned.statistics);
  }
  out.plan = std::move(print);
  return out;
}

}  // namespace weft::motion
