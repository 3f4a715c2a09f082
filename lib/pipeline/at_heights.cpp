// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/at_heights.h"

#include "settings/value.h"

#include <algorithm>
#include <iterator>
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

void go_over(const MachineSettings& machine, Um standing, Point3 from, LayerPlan& layer) {
  constexpr Um clearance = 2000;
  const auto first = std::find_if(layer.steps.begin(), layer.steps.end(), [](const Step& step) {
    const auto* bead = std::get_if<Extrude>(&step);
    return bead != nullptr && !bead->path.empty();
  });
  if (first == layer.steps.end()) return;
  const Point3 to = place_of(std::get<Extrude>(*first), 0, layer.z);
  const Um over = std::max(from.z, std::min(standing + clearance, reach_z_max(machine)));
  Travel way;
  way.path = {{from.x, from.y, over}, {to.x, to.y, over}};
  std::vector<Step> steps;
  steps.emplace_back(std::in_place_type<Retract>);
  steps.emplace_back(std::in_place_type<Travel>, std::move(way));
  put_before(layer, std::move(steps));
}

}  // namespace weft::pipeline
