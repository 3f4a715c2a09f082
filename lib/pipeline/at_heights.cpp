// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/at_heights.h"

#include "settings/value.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

/// The first layer of the rise that reaches above the mark; none: nothing is printed there.
std::size_t layer_above(std::span<const TimelineLayer> layers, std::size_t begin, std::size_t end, Um z) {
  std::size_t i = begin;
  while (i < end && layers[i].z <= z) ++i;
  return i;
}

}  // namespace

std::vector<std::vector<Pause>> pauses_of(const ToolSettings& settings, std::span<const TimelineLayer> layers,
                                          Notices& notices) {
  std::vector<std::vector<Pause>> out(layers.size());
  const auto add = [&](const HeightMarks& marks, std::string_view key, bool swaps) {
    for (const auto& mark : marks) {
      bool found = false;
      for (std::size_t begin = 0; begin < layers.size();) {
        std::size_t end = begin + 1;
        while (end < layers.size() && !layers[end].time.comes_down) ++end;
        if (const auto i = layer_above(layers, begin, end, mark.z); i < end)
          out[i].push_back({mark.text, swaps}), found = true;
        begin = end;
      }
      if (!found)
        notices.push_back(
            {"height_mark_above_print", fmt::format("{}: nothing is printed above {} mm, and nothing happens there",
                                                    key, value::number(to_mm(mark.z)))});
    }
  };
  add(settings.color_change_at_heights, "color_change_at_heights", true);
  add(settings.pause_at_heights, "pause_at_heights", false);
  return out;
}

void put_before(LayerPlan& layer, std::vector<Step> before) {
  std::vector<Step> out = std::move(before);
  bool there = false;  // the way to the first bead is done
  for (std::size_t i = 0; i < layer.steps.size(); ++i) {
    Step& step = layer.steps[i];
    const auto* bead = std::get_if<Extrude>(&step);
    if (!there && bead != nullptr && !bead->path.empty()) {
      Travel way;
      way.path.push_back(place_of(*bead, 0, layer.z));
      out.emplace_back(std::in_place_type<Travel>, std::move(way));
      out.emplace_back(std::in_place_type<Prime>);
      there = true;
    }
    const bool travels = std::holds_alternative<Travel>(step);
    out.push_back(std::move(step));
    if (there || !travels) continue;
    const auto* next = i + 1 < layer.steps.size() ? &layer.steps[i + 1] : nullptr;
    if (next != nullptr && std::holds_alternative<Travel>(*next)) continue;  // one way
    if (next == nullptr || !std::holds_alternative<Prime>(*next)) out.emplace_back(std::in_place_type<Prime>);
    there = true;
  }
  layer.steps = std::move(out);
}

void pause_before(LayerPlan& layer, const std::vector<Pause>& pauses) {
  if (pauses.empty()) return;
  std::vector<Step> steps;
  steps.emplace_back(std::in_place_type<Retract>);
  for (const auto& pause : pauses) steps.emplace_back(std::in_place_type<Pause>, pause);
  put_before(layer, std::move(steps));
}

std::vector<Um> heights_before(const Timeline& timeline, Um z_offset) {
  std::vector<Um> out{0};
  for (const auto& layer : timeline) out.push_back(std::max(out.back(), layer.z + z_offset));
  return out;
}

namespace {

/// How high the nozzle passes over what stands.
Um height_over(const MachineSettings& machine, Um standing) {
  constexpr Um clearance = 2000;
  return std::min(standing + clearance, reach_z_max(machine));
}

/// Is what is laid next behind a step purged?
bool next_is_purged(const LayerPlan& layer, std::size_t step) {
  for (std::size_t i = step + 1; i < layer.steps.size(); ++i)
    if (const auto* bead = std::get_if<Extrude>(&layer.steps[i])) return bead->role == Role::wipe_tower;
  return false;
}

/// Where the nozzle first goes: to its first bead, or the tower where its tool is changed before.
std::optional<Point> first_place(const LayerPlan& layer) {
  for (const auto& step : layer.steps) {
    if (const auto* travel = std::get_if<Travel>(&step); travel != nullptr && !travel->path.empty())
      return flat(travel->path.back());
    if (const auto* bead = std::get_if<Extrude>(&step); bead != nullptr && !bead->path.empty())
      return flat(place_of(*bead, 0, layer.z));
  }
  return std::nullopt;
}

}  // namespace

void go_over(const MachineSettings& machine, Um standing, Point3 from, LayerPlan& layer) {
  const auto to = first_place(layer);
  if (!to) return;
  const Um over = std::max(from.z, height_over(machine, standing));
  Travel way;
  way.path = {{from.x, from.y, over}, {to->x, to->y, over}};
  std::vector<Step> steps;
  steps.emplace_back(std::in_place_type<Retract>);
  steps.emplace_back(std::in_place_type<Travel>, std::move(way));
  put_before(layer, std::move(steps));
}

void leave_over(const MachineSettings& machine, Um standing, LayerPlan& layer) {
  const Um over = height_over(machine, standing);
  std::vector<Step> steps;
  std::optional<Point3> left;  // where the last bead of what is purged ends
  for (auto& step : layer.steps) {
    if (const auto* bead = std::get_if<Extrude>(&step); bead != nullptr && !bead->path.empty())
      left = bead->role == Role::wipe_tower ? std::optional(place_of(*bead, bead->path.size() - 1, layer.z))
                                            : std::nullopt;
    auto* travel = std::get_if<Travel>(&step);
    const bool goes = travel != nullptr && !travel->path.empty() && left;
    const std::size_t at = static_cast<std::size_t>(&step - layer.steps.data());
    if (!goes || next_is_purged(layer, at)) {
      steps.push_back(std::move(step));
      continue;
    }
    const Point3 to = travel->path.back();
    travel->path = {{left->x, left->y, over}, {to.x, to.y, over}, to};
    steps.emplace_back(std::in_place_type<Retract>);
    steps.push_back(std::move(step));
    steps.emplace_back(std::in_place_type<Prime>);
    left.reset();
  }
  layer.steps = std::move(steps);
}

}  // namespace weft::pipeline
