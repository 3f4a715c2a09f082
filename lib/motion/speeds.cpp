// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/speeds.h"

#include "core/stop.h"
#include "model/flow.h"
#include "motion/even_curves.h"
#include "motion/resample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace weft::motion {
namespace {

/// Kinds of steps that have no speed, and stay.
template <class T>
struct OneStays {
  constexpr bool operator()(const T&) const { return true; }
};
template <class... T>
struct Stays : OneStays<T>... {
  using OneStays<T>::operator()...;
};

/// Speeds of neighbouring segments closer together than this are made one, so that F is not repeated at every move.
constexpr double same_speed = 1.05;

double area_mm2(const Junction& j, double height_mm) {
  return to_mm(j.width) * static_cast<double>(j.flow) * height_mm;
}

/// Widths of these follow the place that they fill, or the density that was asked for.
bool varies_in_width(Role role) {
  return is_wall(role) || role == Role::gap_fill || role == Role::infill;
}

/// The cross-section that such a bead has at nominal width, mm². Gaps are filled with what inner walls are made of.
double nominal_area_mm2(const Rules& rules, Role role, Um height) {
  const Um nozzle = rules.machine.nozzle_diameter;
  const auto width = [&] {
    if (role == Role::outer_wall)
      return length_or(rules.walls.wall_line_width_0, nozzle, flow::automatic_outer_width(nozzle));
    if (role == Role::infill)
      return length_or(rules.infill_line_width, nozzle, flow::automatic_width(nozzle, height, false));
    return length_or(rules.walls.wall_line_width_x, nozzle, flow::automatic_width(nozzle, height));
  };
  return flow::area_mm2(to_mm(width()), to_mm(height));
}

/// The length of the closed bead that this is, or was cut from; 0: it is an open one.
double loop_um(const Extrude& bead) {
  if (bead.loop_length > 0) return bead.loop_length;
  if (bead.path.front().at != bead.path.back().at) return 0;
  double um = 0;
  for (std::size_t i = 1; i < bead.path.size(); ++i) um += distance(bead.path[i - 1].at, bead.path[i].at);
  return um;
}

/// What small closed walls are slowed to.
double with_small_perimeter(const Rules& rules, const Extrude& bead, double speed_mm_s) {
  if (!rules.speeds.speed_small_perimeter || !is_wall(bead.role)) return speed_mm_s;
  const double um = loop_um(bead);
  if (um == 0 || um > rules.speeds.small_perimeter_length) return speed_mm_s;
  return std::min(speed_mm_s, rules.speeds.speed_small_perimeter->of(speed_mm_s));
}

/// By the quarters of its width that a bead lies over air with.
constexpr std::array over_air_speeds{&SpeedSettings::speed_overhang_25, &SpeedSettings::speed_overhang_50,
                                     &SpeedSettings::speed_overhang_75, &SpeedSettings::speed_overhang_100};

/// What hangs is slowed to this. What hangs with all of its width has a role of its own, and its speed.
double with_overhang(const Rules& rules, const Extrude& bead, double speed_mm_s) {
  if (bead.air_quarters == 0 || row_of(bead.role).over_air) return speed_mm_s;
  return std::min(speed_mm_s, (rules.speeds.*over_air_speeds.at(bead.air_quarters - 1U)).of(speed_mm_s));
}

/// Joins neighbours of nearly the same speed at the lowest of them; one speed for the whole bead where that will do.
void store(const std::vector<double>& segments, Extrude& bead) {
  std::vector<float> speeds(segments.size());
  bool one = true;
  for (std::size_t i = 0; i < segments.size();) {
    double least = segments[i], most = least;
    std::size_t end = i + 1;
    for (; end < segments.size(); ++end) {
      const double v = segments[end];
      if (std::max(most, v) > same_speed * std::min(least, v)) break;
      least = std::min(least, v), most = std::max(most, v);
    }
    std::fill(speeds.begin() + static_cast<std::ptrdiff_t>(i), speeds.begin() + static_cast<std::ptrdiff_t>(end),
              static_cast<float>(least));
    one = one && end - i == segments.size();
    bead.speed_mm_s = i == 0 ? least : std::min(bead.speed_mm_s, least);
    i = end;
  }
  if (!one) bead.segment_speed_mm_s = std::move(speeds);
}

}  // namespace

double feature_speed_mm_s(const Rules& rules, Role role) {
  const auto& s = rules.speeds;
  const auto& from = row_of(role).speed;
  if (from.own && s.*from.own) return *(s.*from.own);
  const double base = s.*from.speed;
  return from.share ? (s.*from.share).of(base) : base;
}

double feature_acceleration_mm_s2(const Rules& rules, Role role) {
  const auto& s = rules.speeds;
  double a = s.acceleration_print;
  for (const auto own : row_of(role).acceleration)
    if (own && s.*own) {
      a = *(s.*own);
      break;
    }
  return std::min({a, rules.machine.machine_max_acceleration_x, rules.machine.machine_max_acceleration_y});
}

double bead_acceleration_mm_s2(const Rules& rules, const Extrude& bead) {
  const double a = feature_acceleration_mm_s2(rules, bead.role);
  constexpr std::uint8_t more_than_half = 3;  // quarters
  if (bead.air_quarters < more_than_half || !rules.speeds.acceleration_overhang) return a;
  return std::min({*rules.speeds.acceleration_overhang, rules.machine.machine_max_acceleration_x,
                   rules.machine.machine_max_acceleration_y});
}

double travel_acceleration_mm_s2(const Rules& rules) {
  return std::min({rules.speeds.acceleration_travel.value_or(rules.speeds.acceleration_print),
                   rules.machine.machine_max_acceleration_x, rules.machine.machine_max_acceleration_y});
}

void set_bead_speed(const Rules& rules, Extrude& bead) {
  const double speed =
      with_overhang(rules, bead, with_small_perimeter(rules, bead, feature_speed_mm_s(rules, bead.role)));
  const double height_mm = to_mm(bead.height), share = rules.material.material_flow / 100.0;
  const double most_mm3_s = rules.material.material_max_volumetric_speed;
  const double factor = varies_in_width(bead.role) ? rules.speeds.speed_equalize_flow_width_factor / 100.0 : 0;
  // sparse infill of several layers at once flows so many times, at any width
  const double layers = bead.role == Role::infill ? static_cast<double>(bead.path.front().flow) : 1;
  const double nominal = factor > 0 ? layers * nominal_area_mm2(rules, bead.role, bead.height) : 0;
  const auto wanted = [&](double area) {  // at one place, of that band's area (without material_flow)
    if (area <= 0) return speed;
    const double v = factor > 0
                         ? std::min(speed * (1 + factor * (nominal / area - 1)),
                                    std::max(speed, rules.speed_travel_above.value_or(rules.speeds.speed_travel)))
                         : speed;
    return std::min(v, most_mm3_s / (area * share));
  };

  bead.segment_speed_mm_s.clear();
  const auto& path = bead.path;
  const bool even = std::all_of(path.begin(), path.end(),
                                [&](const Junction& j) { return j.width == path[0].width && j.flow == path[0].flow; });
  if (even) {
    bead.speed_mm_s = wanted(area_mm2(path[0], height_mm));
    return;
  }
  std::vector<double> segments(path.size() - 1);
  for (std::size_t i = 0; i + 1 < path.size(); ++i) {
    const double a = area_mm2(path[i], height_mm), b = area_mm2(path[i + 1], height_mm);
    segments[i] = std::min(wanted(a), wanted(b));
  }
  store(segments, bead);
}

namespace {
/// A wipe from where the nozzle is, and how much is drawn back before it so that the extruder keeps up.
void set_wipe(const Rules& rules, double speed_mm_s, std::optional<Point3> at, Retract& retract) {
  double um = at ? distance(flat(*at), retract.wipe.front()) : 0;
  um += length_of(retract.wipe);
  retract.wipe_speed_mm_s = speed_mm_s;
  const double amount_mm = to_mm(rules.retraction.retraction_amount);
  const double while_wiping_mm = rules.retraction.retraction_retract_speed * um / 1000.0 / speed_mm_s;
  retract.before_wipe = rules.retraction.firmware_retraction || amount_mm <= 0
                            ? 1
                            : std::max(rules.retraction.retract_before_wipe / 100.0, 1 - while_wiping_mm / amount_mm);
}

/// Moves, speed and acceleration.
/// @param z of the layer's top
void set_bead(const Rules& rules, Um z, Extrude& bead) {
  const bool on_bed = z <= bead.height;  // seen from below
  if (bead.below.empty()) resample(bead.path, on_bed ? Coarseness{} : coarseness(bead.role));
  set_bead_speed(rules, bead);
  bead.acceleration_mm_s2 = rules.speeds.acceleration_enabled ? bead_acceleration_mm_s2(rules, bead) : 0;
  if (rules.speeds.speed_curvature_even > 0 && bead.role == Role::outer_wall) even_curves(rules, bead);
}
}  // namespace

void set_speeds(AllRules all, LayerPlan& layer, std::optional<Point3> start) {
  const Rules& rules = of_scope(all, layer.scope);
  const bool write_accelerations = rules.speeds.acceleration_enabled;
  const double travel_speed = rules.speeds.speed_travel;
  const auto set_travel = [&](Travel& travel) {
    travel.speed_mm_s = travel_speed;
    travel.z_speed_mm_s = std::min(rules.speeds.speed_z_hop, rules.machine.machine_max_speed_z);
    travel.acceleration_mm_s2 = write_accelerations ? travel_acceleration_mm_s2(rules) : 0;
  };
  std::vector<Step> steps;
  steps.reserve(layer.steps.size() + 8);
  auto at = start;
  ToolId tool = all.loaded;
  const overloaded set{
      // @returns whether the step stays
      [&](Extrude& bead) {
        if (bead.path.size() < 2) return false;
        const Point3 first = place_of(bead, 0, layer.z);
        if (at != first) {
          Travel travel{.path = {first}};
          set_travel(travel);
          steps.emplace_back(std::move(travel));
        }
        set_bead(of_scope(all, bead.scope), layer.z, bead);
        at = place_of(bead, bead.path.size() - 1, layer.z);
        return true;
      },
      [&](Travel& travel) {
        if (travel.path.empty()) return false;
        set_travel(travel);
        at = travel.path.back();
        return true;
      },
      [&](Retract& retract) {
        if (retract.wipe.empty()) return true;
        set_wipe(of_tool(all, tool, rules), travel_speed, at, retract);
        at = Point3{retract.wipe.back().x, retract.wipe.back().y, at ? at->z : layer.z};
        return true;
      },
      [&](ToolChange& change) {
        tool = change.tool;
        return true;
      },
      [&](Feed& feed) {
        if (feed.moves) at = Point3{feed.to.x, feed.to.y, at ? at->z : layer.z};
        return true;
      },
      Stays<Prime, SetFan, ObjectStart, ObjectEnd, SetTemperature, Pause, SetPressureAdvance>{},
  };
  StopNowAndThen stop(16);
  for (auto& step : layer.steps) {
    stop.step();
    if (std::visit(set, step)) steps.push_back(std::move(step));
  }
  layer.steps = std::move(steps);
}

}  // namespace weft::motion
