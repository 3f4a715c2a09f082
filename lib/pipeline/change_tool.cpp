// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/change_tool.h"

#include "pipeline/swap_filament.h"
#include "settings/first_layer.h"
#include "settings/tools.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace weft::pipeline {
namespace {

bool shares(const std::vector<Settings>& tools, const ToolPass& pass) {
  return nozzle_of(tools, *pass.from) == nozzle_of(tools, pass.tool);
}

/// Along straight lines, lifted where the tool lifts travels or as high as it is, and down to the tower over its
/// beginning.
/// @param z of the layer @param low where it ends
/// @param from nothing: it is not known, and the layer has just begun, above all that is printed
Travel way_to(const Settings& tool, const std::optional<Point3>& from, Point to, Um z, Um low) {
  const auto& r = tool.retraction;
  const Um hop = z >= r.retraction_hop_above && z <= r.retraction_hop_below.value_or(max_coord) ? r.retraction_hop : 0;
  const Um high = std::max({z, std::min(z + hop, tool.machine.machine_height), from ? from->z : 0});
  Travel out;
  out.crosses_wall = true;
  if (from && high > from->z) out.path.push_back({from->x, from->y, high});
  if (high > low) out.path.push_back({to.x, to.y, high});
  out.path.push_back({to.x, to.y, low});
  return out;
}

int celsius_of(const Settings& tool, bool first_layer) {
  const auto& m = first_layer ? on_first_layer(tool).material : tool.material;
  return m.material_print_temperature;
}

}  // namespace

bool swaps_filament(const std::vector<Settings>& tools, const ToolPass& pass) {
  return pass.changes && pass.from && shares(tools, pass) && tools[*pass.from].tools.parking_pos_retraction > 0;
}

double rammed_mm3(const std::vector<Settings>& tools, const ToolPass& pass) {
  if (!pass.changes || !pass.from) return 0;
  const auto& t = tools[*pass.from].tools;
  if (!shares(tools, pass)) return t.filament_multitool_ramming_volume;
  return swaps_filament(tools, pass) ? volume_of(ramming_of(t)) : 0;
}

std::optional<Point3> place_behind(const LayerPlan& layer) {
  const Point3 nowhere{max_coord, max_coord, max_coord};
  const Point3 end = end_of(layer, nowhere);
  return end == nowhere ? std::nullopt : std::optional(end);
}

std::vector<Step> change_before(const Passes& passes, std::size_t index, const ToolScopes& tools,
                                const LayerPlan& layer, const std::optional<Point3>& from) {
  using Heater = SetTemperature::Heater;
  const auto& pass = passes.passes[index];
  const auto& all = tools.tools();
  if (!pass.changes) return {};
  if (!pass.from) return {ToolChange{pass.tool}};  // the start G-code has heated
  const auto &before = all[*pass.from], &after = all[pass.tool];
  const bool shared = shares(all, pass), swaps = swaps_filament(all, pass);
  const bool first_layer = layer.time.first();
  const Um low = layer.z - passes.lag_of(pass.layer);
  std::vector<Step> out;
  const auto ram = passes.ram.find(index);
  const auto entry = passes.entry.find(index);
  const auto goal = ram != passes.ram.end()       ? std::optional(ram->second.line.path.front().at)
                    : entry != passes.entry.end() ? std::optional(entry->second.front())
                                                  : std::nullopt;
  if (goal) {
    out.emplace_back(std::in_place_type<Retract>);
    out.emplace_back(way_to(before, from, *goal, layer.z, low));
    if (shared || ram != passes.ram.end()) out.emplace_back(std::in_place_type<Prime>);
  }
  const auto add = [&](std::vector<Step> steps) {
    out.insert(out.end(), std::make_move_iterator(steps.begin()), std::make_move_iterator(steps.end()));
  };
  if (ram != passes.ram.end()) add(lay_rammed(before, ram->second.line, ram->second.height, shared));
  const int celsius = celsius_of(after, first_layer), was = celsius_of(before, first_layer);
  // It gets hotter while the tip cools far above; colder it would not melt what is to be purged.
  if (swaps && celsius > was) out.emplace_back(SetTemperature{Heater::nozzle, any_tool, celsius, false});
  const Along along = entry == passes.entry.end() ? Along{} : Along{entry->second};
  if (swaps) add(unload(before, along, low));
  if (!shared) out.emplace_back(Retract{.wipe = {}, .to_change = true});
  out.emplace_back(ToolChange{pass.tool});
  if (!shared)
    out.emplace_back(SetTemperature{Heater::nozzle, pass.tool, celsius, true});
  else if (celsius != was)
    out.emplace_back(SetTemperature{Heater::nozzle, any_tool, celsius, true});
  if (swaps) add(load(after, along, low));
  return out;
}

}  // namespace weft::pipeline
