// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/cooling.h"

#include <algorithm>
#include <numeric>

namespace weft::motion {
namespace {
constexpr double close_enough_s = 0.01;
}

Slowdown slowdown_for(const Rules& rules, const std::vector<Move>& moves, double seconds_now) {
  const double wanted_s = rules.cooling.cool_min_layer_time;
  if (seconds_now >= wanted_s || std::none_of(moves.begin(), moves.end(), [](const Move& m) { return m.prints; }))
    return {};
  std::vector<double> seconds;
  const auto time_at = [&](double factor) {
    seconds_of(rules.machine, moves, {factor, rules.cooling.cool_min_speed}, seconds);
    return std::accumulate(seconds.begin(), seconds.end(), 0.0);
  };
  double slow = 0, fast = 1;  // time_at(slow) >= wanted > time_at(fast)
  if (time_at(slow) <= wanted_s) return {slow, rules.cooling.cool_min_speed};
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (slow + fast), s = time_at(middle);
    (s >= wanted_s ? slow : fast) = middle;
    if (s >= wanted_s && s < wanted_s + close_enough_s) break;
  }
  return {slow, rules.cooling.cool_min_speed};
}

void slow_down(LayerPlan& layer, const Slowdown& slowdown) {
  const overloaded slow{
      [&](Extrude& bead) {
        bead.speed_mm_s = slowdown.of(bead.speed_mm_s);
        for (auto& v : bead.segment_speed_mm_s) v = static_cast<float>(slowdown.of(static_cast<double>(v)));
      },
      LeavesAlone<Travel, Retract, Prime, SetFan, ObjectStart, ObjectEnd, ToolChange, SetTemperature, Pause>{}};
  for (auto& step : layer.steps) std::visit(slow, step);
}

double fan_share(const CoolingSettings& cooling, std::size_t number, double seconds) {
  const auto off = static_cast<std::size_t>(cooling.cool_fan_off_layers),
             full = static_cast<std::size_t>(cooling.cool_fan_full_layer);
  if (!cooling.cool_fan_enabled) return 0;
  if (number < off) return cooling.cool_fan_speed_0 / 100.0;
  const double least = cooling.cool_fan_speed_min, most = std::max(least, cooling.cool_fan_speed_max);
  const double fast_s = cooling.cool_min_layer_time, slow_s = cooling.cool_min_layer_time_fan_speed_max;
  double percent = most;
  if (seconds >= std::max(fast_s, slow_s))
    percent = cooling.cool_fan_always_on ? least : 0;
  else if (seconds > fast_s)
    percent = most + (least - most) * (seconds - fast_s) / (slow_s - fast_s);
  if (number + 1 < full) {  // from cool_fan_speed_0 in the last layer without fan to all of it in layer `full`
    const double t = static_cast<double>(number + 1 - off) / static_cast<double>(full - off);
    percent = cooling.cool_fan_speed_0 + t * (percent - cooling.cool_fan_speed_0);
  }
  return percent / 100.0;
}

void set_fan(const CoolingSettings& cooling, LayerPlan& layer, double seconds) {
  const std::size_t number = layer.time.number;
  const double share = fan_share(cooling, number, seconds);
  const bool over_air_too = cooling.cool_fan_enabled && number >= static_cast<std::size_t>(cooling.cool_fan_off_layers);
  const double over_air = over_air_too ? std::max(share, cooling.bridge_fan_speed / 100.0) : share;
  std::vector<Step> steps;
  steps.reserve(layer.steps.size() + 8);
  steps.emplace_back(SetFan{share});
  double now = share;
  const overloaded before{
      [&](const Extrude& bead) {
        const double wanted = row_of(bead.role).over_air ? over_air : share;
        if (wanted != now) steps.emplace_back(SetFan{now = wanted});
      },
      LeavesAlone<Travel, Retract, Prime, SetFan, ObjectStart, ObjectEnd, ToolChange, SetTemperature, Pause>{}};
  for (auto& step : layer.steps) {
    std::visit(before, step);
    steps.push_back(std::move(step));
  }
  layer.steps = std::move(steps);
}

}  // namespace weft::motion
