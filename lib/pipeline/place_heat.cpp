// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/place_heat.h"

#include "tools/heat.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <variant>

namespace weft::pipeline {
namespace {

/// Moments that are nearer than this are one: sums of floats.
constexpr double same_moment_s = 1e-3;

}  // namespace

LayerTimes times_of(const LayerPlan& layer, std::vector<float> step_s) {
  LayerTimes out{layer.time.first(), std::move(step_s), {}};
  for (std::size_t i = 0; i < layer.steps.size(); ++i)
    if (const auto* change = std::get_if<ToolChange>(&layer.steps[i])) out.changes.emplace_back(i, change->tool);
  return out;
}

void place_heat(const std::vector<Settings>& tools, const std::vector<LayerTimes>& layers, PlannedPlate& plate) {
  std::vector<std::vector<double>> begins;  // of each step, since the print began
  std::vector<tools::Change> changes;
  double now = 0;
  for (const auto& layer : layers) {
    auto& own = begins.emplace_back();
    own.reserve(layer.step_s.size());
    for (const float s : layer.step_s) own.push_back(now), now += static_cast<double>(s);
    for (const auto& [step, tool] : layer.changes) changes.push_back({own[step], tool, layer.first});
  }
  auto wanted = tools::heat_plan(tools, changes);
  plate.cold_at_start = std::move(wanted.cold_at_start);
  plate.heat.assign(layers.size(), {});
  std::size_t layer = 0;
  for (const auto& heating : wanted.heatings) {
    const auto begins_by = [&](std::size_t i) {
      return !begins[i].empty() && begins[i].front() <= heating.s + same_moment_s;
    };
    while (layer + 1 < layers.size() && begins_by(layer + 1)) ++layer;
    const auto& own = begins[layer];
    if (own.empty()) continue;
    auto at = std::upper_bound(own.begin(), own.end(), heating.s + same_moment_s);
    if (at != own.begin()) --at;
    while (at != own.begin() && *std::prev(at) > heating.s - same_moment_s)
      --at;  // the first of steps that take no time
    plate.heat[layer].emplace_back(
        static_cast<std::size_t>(at - own.begin()),
        SetTemperature{SetTemperature::Heater::nozzle, heating.tool, heating.celsius, false});
  }
}

void add_heat(const std::vector<std::pair<std::size_t, SetTemperature>>& heat, LayerPlan& layer) {
  if (heat.empty()) return;
  std::vector<Step> out;
  out.reserve(layer.steps.size() + heat.size());
  auto next = heat.begin();
  for (std::size_t i = 0; i < layer.steps.size(); ++i) {
    for (; next != heat.end() && next->first <= i; ++next) out.emplace_back(next->second);
    out.push_back(std::move(layer.steps[i]));
  }
  for (; next != heat.end(); ++next) out.emplace_back(next->second);
  layer.steps = std::move(out);
}

}  // namespace weft::pipeline
