// SPDX-License-Identifier: GPL-3.0-or-later
#include "motion/cooling.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <optional>

namespace weft::motion {
namespace {
constexpr double close_enough_s = 0.01;
}

std::size_t times_laid(const LayerPlan& layer) {
  return 1 + static_cast<std::size_t>(std::count_if(layer.steps.begin(), layer.steps.end(), [](const Step& step) {
           const auto* bead = std::get_if<Extrude>(&step);
           return bead != nullptr && !bead->follows_surface && !bead->below.empty() &&
                  std::all_of(bead->below.begin(), bead->below.end(), [](Um below) { return below == 0; });
         }));
}

Slowdown slowdown_for(const Rules& rules, const std::vector<Move>& moves, double seconds_now, std::size_t times) {
  const double wanted_s = rules.cooling.cool_min_layer_time * static_cast<double>(times);
  if (seconds_now >= wanted_s || std::none_of(moves.begin(), moves.end(), [](const Move& m) { return m.prints; }))
    return {};
  std::vector<double> seconds;
  const auto time_at = [&](double most_mm_s) {
    seconds_of(rules.machine, moves, {most_mm_s}, seconds);
    return std::accumulate(seconds.begin(), seconds.end(), 0.0);
  };
  double slow = rules.cooling.cool_min_speed, fast = slow;  // time_at(slow) >= wanted > time_at(fast)
  for (const Move& m : moves)
    if (m.prints) fast = std::max(fast, m.speed_mm_s);
  if (time_at(slow) <= wanted_s) return {slow};
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (slow + fast), s = time_at(middle);
    (s >= wanted_s ? slow : fast) = middle;
    if (s >= wanted_s && s < wanted_s + close_enough_s) break;
  }
  return {slow};
}

void slow_down(LayerPlan& layer, const Slowdown& slowdown) {
  const overloaded slow{[&](Extrude& bead) {
                          bead.speed_mm_s = slowdown.of(bead.speed_mm_s);
                          for (auto& v : bead.segment_speed_mm_s)
                            v = static_cast<float>(slowdown.of(static_cast<double>(v)));
                        },
                        LeavesAlone<Travel, Retract, Prime, SetFan, ObjectStart, ObjectEnd, ToolChange, SetTemperature,
                                    Feed, Pause, SetPressureAdvance>{}};
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

namespace {

/// By the quarters of its width that a bead lies over air with.
constexpr std::array over_air_fans{&CoolingSettings::overhang_fan_speed_25, &CoolingSettings::overhang_fan_speed_50,
                                   &CoolingSettings::overhang_fan_speed_75, &CoolingSettings::overhang_fan_speed_100};

/// The fan that what a bead lies over asks for; nothing: the layer's.
std::optional<double> over_air_percent(const CoolingSettings& cooling, const Extrude& bead) {
  if (row_of(bead.role).over_air) return cooling.bridge_fan_speed;
  if (bead.air_quarters == 0) return std::nullopt;
  const auto own = cooling.*over_air_fans.at(bead.air_quarters - 1U);
  return own || bead.air_quarters <= 2 ? own : cooling.bridge_fan_speed;
}

/// The fan that support has, or what lies on it; nothing: the layer's.
std::optional<double> of_support_percent(const CoolingSettings& cooling, const Extrude& bead) {
  if (bead.on_support && cooling.support_fan_enable) return cooling.support_supported_skin_fan_speed;
  if (bead.role == Role::support_interface) return cooling.support_interface_fan_speed;
  return std::nullopt;
}

/// The fan for each bead of a layer in their order; where it would turn slower for less time than a fan takes to, it
/// does not.
template <class F>
std::vector<double> without_short_lulls(const std::vector<Step>& steps, const F& fan_of) {
  constexpr double to_slow_down_s = 1;
  std::vector<double> wanted;
  double lull_s = 0;
  std::size_t high = 0;  // the last bead before the lull, which began after it
  for (const Step& step : steps) {
    const auto* bead = std::get_if<Extrude>(&step);
    if (bead == nullptr) continue;
    wanted.push_back(fan_of(*bead));
    const std::size_t i = wanted.size() - 1;
    if (wanted[i] >= wanted[high]) {
      if (lull_s < to_slow_down_s)
        for (std::size_t k = high + 1; k < i; ++k) wanted[k] = wanted[high];
      high = i, lull_s = 0;
      continue;
    }
    double um = 0;
    for (std::size_t k = 1; k < bead->path.size(); ++k) um += distance(bead->path[k - 1].at, bead->path[k].at);
    lull_s += um / 1000 / std::max(bead->speed_mm_s, 1e-3);
    if (lull_s >= to_slow_down_s) high = i, lull_s = 0;
  }
  return wanted;
}

}  // namespace

void set_fan(const CoolingSettings& cooling, LayerPlan& layer, double seconds) {
  const std::size_t number = layer.time.number;
  const double share = fan_share(cooling, number, seconds);
  const bool over_air_too = cooling.cool_fan_enabled && number >= static_cast<std::size_t>(cooling.cool_fan_off_layers);
  const auto fan_of = [&](const Extrude& bead) {
    if (const auto own = over_air_too ? of_support_percent(cooling, bead) : std::nullopt) return *own / 100.0;
    return over_air_too ? std::max(share, over_air_percent(cooling, bead).value_or(0) / 100.0) : share;
  };
  const std::vector<double> wanted = without_short_lulls(layer.steps, fan_of);
  std::vector<Step> steps;
  steps.reserve(layer.steps.size() + 8);
  steps.emplace_back(SetFan{share});
  double now = share;
  std::size_t next = 0;  // of `wanted`
  const overloaded before{[&](const Extrude&) {
                            const double fan = wanted[next++];
                            if (fan != now) steps.emplace_back(SetFan{now = fan});
                          },
                          LeavesAlone<Travel, Retract, Prime, SetFan, ObjectStart, ObjectEnd, ToolChange,
                                      SetTemperature, Feed, Pause, SetPressureAdvance>{}};
  for (auto& step : layer.steps) {
    std::visit(before, step);
    steps.push_back(std::move(step));
  }
  layer.steps = std::move(steps);
}

}  // namespace weft::motion
