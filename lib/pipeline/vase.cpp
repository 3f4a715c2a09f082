// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/vase.h"

#include "core/error.h"
#include "settings/tools.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

bool is_wall(const Bead& bead) {
  return weft::is_wall(bead.role);
}

/// One wall that is closed, and nothing around it.
bool is_turn(const travel::LayerInput& layer) {
  if (!layer.adhesion.empty() || layer.objects.size() != 1) return false;
  const auto& beads = layer.objects.front().beads;
  return beads.size() == 1 && beads.front().closed && beads.front().path.size() > 2;
}

/// How many layers the bottom takes; at least the one that lies on the bed.
std::size_t bottom_of(const ShellSettings& shells, std::span<const travel::LayerInput> layers) {
  std::size_t out = 1;
  Um height = layers.empty() ? 0 : layers.front().height;
  while (out < layers.size() && (out < static_cast<std::size_t>(shells.bottom_layers) ||
                                 (shells.bottom_layers > 0 && height < shells.bottom_thickness)))
    height += layers[out++].height;
  return out;
}

/// Takes everything but walls out of the layers [begin, end) of a rise that are above its bottom, and finds its turns.
Vase vase_of(const ShellSettings& shells, std::span<travel::LayerInput> layers, std::size_t begin, std::size_t end) {
  Vase out;
  out.begin = begin + bottom_of(shells, layers.subspan(begin, end - begin));
  for (std::size_t i = out.begin; i < end; ++i)
    for (auto& object : layers[i].objects) {
      std::erase_if(object.beads, [](const Bead& bead) { return !is_wall(bead) || bead.inset > 0; });
      object.skin.clear(), object.top.clear(), object.sparse.clear();
    }
  while (out.begin < end && !layers[out.begin].adhesion.empty()) ++out.begin;
  out.end = out.begin;
  while (out.end < end && is_turn(layers[out.end])) ++out.end;
  return out;
}

Notice ends_at(const travel::LayerInput& layer) {
  const std::size_t walls = layer.objects.empty() ? 0 : layer.objects.front().beads.size();
  return {"spiral_ends", fmt::format("magic_spiralize: at z {:.3f} there {} {} wall{}, not a single closed "
                                     "one: from there on layers are plain",
                                     to_mm(layer.z), walls == 1 ? "is" : "are", walls, walls == 1 ? "" : "s")};
}

}  // namespace

Settings of_vase(Settings s) {
  s.walls.wall_line_count = 1;
  s.walls.alternate_extra_wall = s.walls.wall_extra_on_slopes = false;
  s.infill.infill_sparse_density = 0;
  s.shells.infill_solid_below_area = 0;
  s.shells.infill_solid_every_layers.reset();
  s.shells.top_layers = 0, s.shells.top_thickness = 0;
  s.shells.ironing_enabled = false;
  return s;
}

void check_vase(const Settings& settings, const Plate& plate) {
  std::size_t objects = 0;
  for (const auto& object : plate.objects) objects += object.copies.size();
  const auto refuse = [](const std::string& what, const char* hint) {
    throw Error{Error::Kind::settings, "magic_spiralize: " + what, {}, hint};
  };
  if (objects != 1 && settings.plate.print_sequence != PrintSequence::one_at_a_time)
    refuse(fmt::format("{} objects on the plate; a spiral takes one", objects),
           "print_sequence = one_at_a_time, or each in a file of its own");
  if (tool_count(settings) > 1) refuse(fmt::format("{} tools; a spiral takes one", tool_count(settings)), "");
  if (settings.support.support_enable)
    refuse("support_enable is on; a spiral is never interrupted", "switch one of the two off");
}

travel::SpiralStyle spiral_style(const LayerSettings& layers) {
  return {layers.smooth_spiralized_contours, layers.spiral_smoothing / 100, layers.spiral_start_flow / 100,
          layers.spiral_finish_flow / 100};
}

Vases vases_of(const Settings& settings, std::span<travel::LayerInput> layers, Notices& notices) {
  Vases out;
  for (std::size_t begin = 0; begin < layers.size();) {
    std::size_t end = begin + 1;
    while (end < layers.size() && !layers[end].time.comes_down) ++end;
    out.push_back(vase_of(settings.shells, layers, begin, end));
    if (out.back().end < end) notices.push_back(ends_at(layers[out.back().end]));
    begin = end;
  }
  return out;
}

const Vase* vase_at(const Vases& vases, std::size_t layer) {
  const auto after =
      std::partition_point(vases.begin(), vases.end(), [&](const Vase& vase) { return vase.end <= layer; });
  return after != vases.end() && after->has(layer) ? &*after : nullptr;
}

const Bead& wall_of(const travel::LayerInput& layer) {
  return layer.objects.front().beads.front();
}

void wind(const Vase& vase, std::size_t layer, const Bead& wall, travel::Spiral& spiral, LayerPlan& plan) {
  const bool first = layer == vase.begin;
  std::vector<Step> steps;
  std::optional<Point> start;
  std::uint32_t object = 0;
  for (auto& step : plan.steps) {
    if (const auto* begin = std::get_if<ObjectStart>(&step)) object = begin->object;
    if (const auto* bead = std::get_if<Extrude>(&step)) {
      start = bead->path.front().at;
      break;
    }
    if (first || std::holds_alternative<ObjectStart>(step) || std::holds_alternative<ToolChange>(step) ||
        std::holds_alternative<Pause>(step))
      steps.push_back(std::move(step));
  }
  auto turns = spiral.turn(wall.path, plan.height, {first, layer + 1 == vase.end}, first ? start : std::nullopt);
  for (auto& turn : turns) {
    turn.tool = wall.tool, turn.scope = wall.scope;
    steps.emplace_back(std::move(turn));
  }
  steps.emplace_back(ObjectEnd{object});
  plan.steps = std::move(steps);
}

}  // namespace weft::pipeline
