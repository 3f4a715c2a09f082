// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/pressure_advance.h"

#include "motion/speeds.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace weft::motion {
namespace {

/// A value by a place, places ascending.
using Curve = std::vector<std::pair<double, double>>;

/// The cubic through all of its values that is monotone wherever they are.
double at(const Curve& curve, double x) {
  if (x <= curve.front().first) return curve.front().second;
  if (x >= curve.back().first) return curve.back().second;
  std::size_t i = 0;
  while (x > curve[i + 1].first) ++i;
  const auto width = [&](std::size_t k) { return curve[k + 1].first - curve[k].first; };
  const auto rise = [&](std::size_t k) { return (curve[k + 1].second - curve[k].second) / width(k); };
  const auto slope = [&](std::size_t k) {
    if (k == 0) return rise(0);
    if (k + 1 == curve.size()) return rise(k - 1);
    const double a = rise(k - 1), b = rise(k);
    if (a * b <= 0) return 0.0;
    const double wa = 2 * width(k) + width(k - 1), wb = width(k) + 2 * width(k - 1);
    return (wa + wb) / (wa / a + wb / b);
  };
  const double h = width(i), t = (x - curve[i].first) / h, t2 = t * t, t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * curve[i].second + (t3 - 2 * t2 + t) * h * slope(i) +
         (3 * t2 - 2 * t3) * curve[i + 1].second + (t3 - t2) * h * slope(i + 1);
}

/// Groups rows by `key`, and makes a curve of what `value` says of each group.
template <class Key, class Value>
double along(const PressureRows& rows, double x, const Key& key, const Value& value) {
  std::map<double, PressureRows> groups;
  for (const auto& row : rows) groups[key(row)].push_back(row);
  Curve curve;
  for (const auto& [place, group] : groups) curve.emplace_back(place, value(group));
  return at(curve, x);
}

double mean_advance(const PressureRows& rows) {
  double sum = 0;
  for (const auto& row : rows) sum += row.advance_s;
  return sum / static_cast<double>(rows.size());
}

/// Mean flow of each step, weighted by volume, mm³/s; 0 where nothing is laid.
std::vector<double> flow_of_steps(const LayerPlan& layer, const Rules& rules, const std::vector<Move>& moves,
                                  const std::vector<double>& seconds) {
  const double diameter_mm = to_mm(rules.material.filament_diameter);
  const double area_mm2 = std::numbers::pi / 4 * diameter_mm * diameter_mm;
  std::vector<double> weighted(layer.steps.size()), volume(layer.steps.size());
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const double mm3 = moves[i].e_per_mm * moves[i].length_mm * area_mm2;
    if (mm3 <= 0 || seconds[i] <= 0) continue;
    weighted[moves[i].step] += mm3 * mm3 / seconds[i];
    volume[moves[i].step] += mm3;
  }
  for (std::size_t i = 0; i < volume.size(); ++i) weighted[i] = volume[i] > 0 ? weighted[i] / volume[i] : 0;
  return weighted;
}

}  // namespace

double pressure_advance_s(const PressureRows& rows, double mm3_s, double mm_s2, Um height) {
  const auto by_flow = [&](const PressureRows& group) {
    return along(
        group, mm3_s, [](const PressureRow& row) { return row.mm3_s; }, mean_advance);
  };
  const auto by_acceleration = [&](const PressureRows& group) {
    return along(
        group, mm_s2, [](const PressureRow& row) { return row.mm_s2; }, by_flow);
  };
  return along(
      rows, to_mm(height), [](const PressureRow& row) { return to_mm(row.height.value_or(0)); }, by_acceleration);
}

bool tells_pressure_advance(const AllRules& all, const LayerPlan& layer) {
  const auto has = [](const Rules& rules) { return !rules.material.pressure_advance_model.empty(); };
  return all.tools.empty() ? has(of_scope(all, layer.scope)) : std::any_of(all.tools.begin(), all.tools.end(), has);
}

void tell_pressure_advance(const AllRules& all, const LayerPlan& layer, const std::vector<Move>& moves,
                           const std::vector<double>& seconds, TimedSteps& steps) {
  const Rules& rules = of_scope(all, layer.scope);
  const auto flows = flow_of_steps(layer, rules, moves, seconds);
  const bool anywhere = rules.machine.firmware == Firmware::klipper;
  ToolId tool = all.loaded;
  constexpr double nothing = -1;
  double told = nothing;  // an advance is 0 or more
  constexpr std::size_t none = ~std::size_t{0};
  std::size_t way = none;  // where in `out` the way to the next bead begins
  TimedSteps out;
  for (std::size_t i = 0; i < steps.steps.size(); ++i) {
    auto& step = steps.steps[i];
    const auto* bead = std::get_if<Extrude>(&step);
    if (const auto* change = std::get_if<ToolChange>(&step)) tool = change->tool, told = nothing, way = none;
    const bool leads = std::holds_alternative<Travel>(step) || std::holds_alternative<Prime>(step);
    if (leads && (way == none || std::holds_alternative<Prime>(step))) way = out.steps.size();
    const auto& material = of_tool(all, tool, rules).material;
    if (bead != nullptr && flows[i] > 0 && !material.pressure_advance_model.empty() && (anywhere || way != none)) {
      const double mm_s2 = bead->acceleration_mm_s2 > 0 ? bead->acceleration_mm_s2 : rules.speeds.acceleration_print;
      const double wanted = pressure_advance_s(material.pressure_advance_model, flows[i], mm_s2, bead->height);
      if (told == nothing || std::abs(wanted - told) >= material.pressure_advance_step) {
        const std::size_t place = anywhere ? out.steps.size() : way;
        told = wanted;
        out.steps.insert(out.steps.begin() + static_cast<std::ptrdiff_t>(place), SetPressureAdvance{wanted});
        out.seconds.insert(out.seconds.begin() + static_cast<std::ptrdiff_t>(place), 0.F);
      }
    }
    if (bead != nullptr) way = none;
    out.add(std::move(step), steps.seconds[i]);
  }
  steps = std::move(out);
}

}  // namespace weft::motion
