// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/heat.h"

#include "settings/first_layer.h"
#include "settings/tools.h"

#include <algorithm>
#include <map>

namespace weft::tools {
namespace {

/// Of a room: what a nozzle that was never heated has.
constexpr int room_celsius = 25;
/// Below its printing temperature a nozzle that waits oozes little, and is soon hot again.
constexpr int standby_below = 40;

int celsius_of(const Settings& tool, bool first_layer) {
  return first_layer ? on_first_layer(tool).material.material_print_temperature
                     : tool.material.material_print_temperature;
}

/// A stretch of time in which one of its tools is loaded in a nozzle.
struct Use {
  double from = 0, to = 0;
  ToolId first = 0, last = 0;  ///< of its tools
  bool first_layer = false;    ///< when it begins
};

std::map<int, std::vector<Use>> uses_by_nozzle(const std::vector<Settings>& tools, std::span<const Change> changes) {
  std::map<int, std::vector<Use>> out;
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const auto& change = changes[i];
    const double end = i + 1 < changes.size() ? changes[i + 1].s : -1;  // −1: until the end of the print
    auto& uses = out[nozzle_of(tools, change.to)];
    if (i > 0 && nozzle_of(tools, changes[i - 1].to) == nozzle_of(tools, change.to))
      uses.back().to = end, uses.back().last = change.to;
    else
      uses.push_back({change.s, end, change.to, change.to, change.first_layer});
  }
  return out;
}

/// How long a nozzle takes from one temperature to another.
double heating_s(const Settings& tool, int from, int to) {
  return std::max(0, to - from) / tool.tools.machine_nozzle_heat_up_speed;
}

void wait_between(const std::vector<Settings>& tools, const Use& before, const Use& after, std::vector<Heating>& out) {
  const auto &waits = tools[before.last], &comes = tools[after.first];
  const double gap = after.from - before.to;
  if (gap <= waits.tools.machine_min_cool_heat_time_window) return;
  const int printing = celsius_of(comes, after.first_layer);
  const int standby = waits.tools.material_standby_temperature.value_or(
      std::max(0, waits.material.material_print_temperature - standby_below));
  const double heating = heating_s(comes, std::max(standby, room_celsius), printing);
  if (printing <= standby || heating >= gap) return;
  out.push_back({before.to, before.last, standby});
  out.push_back({after.from - heating, after.first, printing});
}

}  // namespace

HeatPlan heat_plan(const std::vector<Settings>& tools, std::span<const Change> changes) {
  HeatPlan out;
  const double begin = changes.empty() ? 0 : changes.front().s;
  for (const auto& [nozzle, uses] : uses_by_nozzle(tools, changes)) {
    const auto& first = uses.front();
    const auto& tool = tools[first.first];
    const int celsius = celsius_of(tool, first.first_layer);
    const double heating = heating_s(tool, room_celsius, celsius), cold = first.from - begin;
    if (celsius > 0 && cold > tool.tools.machine_min_cool_heat_time_window && heating < cold) {
      out.cold_at_start.push_back(first.first);
      out.heatings.push_back({first.from - heating, first.first, celsius});
    }
    for (std::size_t i = 1; i < uses.size(); ++i) wait_between(tools, uses[i - 1], uses[i], out.heatings);
    if (uses.back().to >= 0) out.heatings.push_back({uses.back().to, uses.back().last, 0});
  }
  std::stable_sort(out.heatings.begin(), out.heatings.end(),
                   [](const Heating& a, const Heating& b) { return a.s < b.s; });
  return out;
}

}  // namespace weft::tools
