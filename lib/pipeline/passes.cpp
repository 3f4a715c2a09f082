// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/passes.h"

#include "core/error.h"
#include "pipeline/at_heights.h"
#include "settings/first_layer.h"
#include "settings/tools.h"
#include "tools/order.h"
#include "tools/purge.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

/// Between the tower and what stands beside it: the head passes there with drawn back filament.
constexpr Um beside_tower = 3000;
/// No bead is higher than this share of its nozzle.
constexpr double highest_by_nozzle = 0.75;

ToolId tool_of_mark(const HeightMark& mark) {
  return static_cast<ToolId>(std::stoi(mark.text.substr(mark.text.starts_with('T') ? 1 : 0)));
}

/// The tool that everything above a mark is printed with.
std::optional<ToolId> only_tool_at(const ToolSettings& settings, Um z) {
  std::optional<ToolId> out;
  for (const auto& mark : settings.tool_change_at_heights)
    if (z > mark.z) out = tool_of_mark(mark);
  return out;
}

void give(Bead& bead, ToolId tool, ToolScopes& tools, Scopes& scopes) {
  bead.tool = tool;
  bead.scope = tools.laid_over(bead.scope, tool, scopes);
}

template <class F>
void for_each_bead(travel::LayerInput& layer, const F& f) {
  for (auto& bead : layer.adhesion) f(bead);
  for (auto& object : layer.objects)
    for (auto& bead : object.beads) f(bead);
}

/// The tools that beads of a layer name.
tools::ToolSets sets_of(const Settings& plate, ToolScopes& tools, Scopes& scopes,
                        std::span<travel::LayerInput> layers) {
  tools::ToolSets out(layers.size());
  const auto adhesion = plate.tools.adhesion_extruder_nr;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const auto only = only_tool_at(plate.tools, layers[i].z);
    if (adhesion)
      for (auto& bead : layers[i].adhesion) give(bead, static_cast<ToolId>(*adhesion), tools, scopes);
    std::set<ToolId> found;
    for_each_bead(layers[i], [&](Bead& bead) {
      if (only && bead.tool != any_tool) give(bead, *only, tools, scopes);
      if (bead.tool != any_tool) found.insert(bead.tool);
    });
    out[i].assign(found.begin(), found.end());
  }
  return out;
}

/// What a change costs: filament that is purged, and time as the filament that is printed meanwhile.
tools::Costs costs_of(const std::vector<Settings>& tools) {
  auto out = tools::purge_volumes(tools);
  for (std::size_t a = 0; a < out.size(); ++a)
    for (std::size_t b = 0; b < out.size(); ++b)
      if (a != b) out[a][b] += tools[b].tools.tool_change_time * tools[b].material.material_max_volumetric_speed / 2;
  return out;
}

/// Tools in the order that they are loaded.
Passes in_order(const tools::ToolSets& ordered) {
  Passes out;
  std::optional<ToolId> loaded;
  ToolId first = 0;
  for (const auto& set : ordered)
    if (!set.empty()) {
      first = set.front();
      break;
    }
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    out.begin.push_back(out.passes.size());
    auto set = ordered[i];
    if (set.empty()) set = {loaded.value_or(first)};
    for (const ToolId tool : set) {
      out.passes.push_back({i, tool, loaded != tool, loaded, false});
      loaded = tool;
    }
  }
  out.begin.push_back(out.passes.size());
  for (std::size_t p = 0; p < out.passes.size(); ++p) {
    auto& pass = out.passes[p];
    if (!pass.changes || !pass.from) continue;
    pass.last_of_from = std::none_of(out.passes.begin() + static_cast<std::ptrdiff_t>(p), out.passes.end(),
                                     [&](const ToolPass& later) { return later.tool == *pass.from; });
  }
  return out;
}

/// Sections up to the last change: one a layer that purges, and between them where a bead would be too high.
void plan_tower(const std::vector<Settings>& tools, std::span<const travel::LayerInput> layers, Passes& passes) {
  const auto volumes = tools::purge_volumes(tools);
  Um nozzle = max_coord;
  for (const auto& tool : tools) nozzle = std::min(nozzle, tool.machine.nozzle_diameter);
  const Um highest = rounded(highest_by_nozzle * nozzle);
  std::size_t last = 0;
  const auto purged = [&](const ToolPass& pass) {
    return pass.changes && pass.from ? volumes[*pass.from][pass.tool] : 0;
  };
  for (const auto& pass : passes.passes)
    if (purged(pass) > 0) last = pass.layer + 1;
  Um below = 0;
  for (std::size_t i = 0; i < last; ++i) {
    tools::TowerLayer section{layers[i].z, layers[i].z - below, {}, passes.begin[i]};
    for (std::size_t p = passes.begin[i]; p < passes.begin[i + 1]; ++p)
      if (const double mm3 = purged(passes.passes[p]); mm3 > 0) section.strips.push_back({p, mm3});
    const bool too_high = i + 1 < last && layers[i + 1].z - below > highest;
    if (section.strips.empty() && !too_high && i != 0) continue;
    below = layers[i].z;
    passes.tower.push_back(std::move(section));
    passes.section_of.push_back(i);
  }
  passes.size = tools::tower_size(tools.front().tools, passes.tower, nozzle);
}

/// The boxes of what is printed, over all layers, with what lies around it on the bed.
std::vector<Box> standing_on(const Settings& plate, std::span<const travel::LayerInput> layers) {
  std::vector<std::pair<std::pair<ObjectId, std::uint32_t>, Box>> by_object;
  for (const auto& layer : layers)
    for (const auto& object : layer.objects) {
      const auto key = std::pair(object.object, object.stack);
      auto at = std::find_if(by_object.begin(), by_object.end(), [&](const auto& b) { return b.first == key; });
      if (at == by_object.end()) at = by_object.insert(at, {key, Box{}});
      for (const auto& region : object.outline) at->second.add(box_of(region.outer));
    }
  const bool brim = plate.adhesion.adhesion_type == AdhesionType::brim;
  std::vector<Box> out;
  for (const auto& [key, box] : by_object)
    if (!box.empty()) out.push_back(box.grown(brim ? plate.adhesion.brim_width : 0));
  for (const auto& layer : layers) {  // a raft
    Box raft;
    for (const auto& bead : layer.adhesion) raft.add(box_of(bead));
    if (!raft.empty()) out.push_back(raft);
  }
  return out;
}

void place_tower(const Settings& plate, std::span<const travel::LayerInput> layers, Passes& passes) {
  const auto& t = plate.tools;
  const Ring surface = print_surface(plate.machine);
  const auto& size = passes.size;
  if (t.prime_tower_position_x && t.prime_tower_position_y) {
    passes.corner = {*t.prime_tower_position_x, *t.prime_tower_position_y};
    const auto outline = tools::tower_outline(t, size, passes.corner);
    const auto outside = tools::outside_of(outline, surface);
    if (outside.by <= plate.audit.audit_tolerance) return;
    const Box bed = box_of(surface);
    const auto side = outside.at.x > bed.max.x   ? "+x"
                      : outside.at.x < bed.min.x ? "-x"
                      : outside.at.y > bed.max.y ? "+y"
                      : outside.at.y < bed.min.y ? "-y"
                                                 : "the edge";
    throw Error{Error::Kind::audit,
                fmt::format("prime_tower_position_x: the tower with its brim, {:.1f} × {:.1f} mm at ({:g}, {:g}), "
                            "leaves the print surface by {:.1f} mm at {}",
                            to_mm(box_of(outline).size().x), to_mm(box_of(outline).size().y), to_mm(passes.corner.x),
                            to_mm(passes.corner.y), to_mm(outside.by), side),
                {},
                "auto puts it where there is room"};
  }
  const auto place = tools::place_for_tower(t, size, surface, plate.machine.bed_exclude_areas,
                                            standing_on(plate, layers), beside_tower);
  if (!place)
    throw Error{Error::Kind::audit,
                fmt::format("prime_tower_enable: no room on the bed for the tower, {:.1f} × {:.1f} mm",
                            to_mm(size.width), to_mm(size.depth)),
                {},
                "move the models, give purge_volumes that are less, or prime_tower_enable = false"};
  passes.corner = *place;
}

}  // namespace

Passes passes_of(const Settings& plate, ToolScopes& tools, Scopes& scopes, std::span<travel::LayerInput> layers,
                 Notices& notices) {
  Passes out;
  if (!tools.several()) {
    for (std::size_t i = 0; i <= layers.size(); ++i) out.begin.push_back(i);
    for (std::size_t i = 0; i < layers.size(); ++i) out.passes.push_back({i, any_tool, false, {}, false});
    return out;
  }
  const auto sets = sets_of(plate, tools, scopes, layers);
  out = in_order(tools::ordered(sets, costs_of(tools.tools()), plate.tools.tool_order));
  const bool changes =
      std::any_of(out.passes.begin(), out.passes.end(), [](const ToolPass& p) { return p.changes && p.from; });
  const bool wanted = plate.tools.prime_tower_enable.value_or(shares_nozzle(tools.tools()));
  if (!changes || !wanted) return out;
  if (std::any_of(layers.begin(), layers.end(), [](const auto& layer) { return layer.time.comes_down; })) {
    notices.push_back(
        {"prime_tower_one_at_a_time", "prime_tower_enable: objects are printed one after the other, and no tower is"});
    return out;
  }
  plan_tower(tools.tools(), layers, out);
  if (out.has_tower()) place_tower(plate, layers, out);
  return out;
}

std::vector<travel::LayerInput> split(const Passes& passes, const Settings& plate, ToolScopes& tools, Scopes& scopes,
                                      std::vector<travel::LayerInput> layers) {
  if (!tools.several()) return layers;
  std::vector<travel::LayerInput> out;
  std::size_t section = 0;
  for (std::size_t i = 0; i < layers.size(); ++i) {
    auto& layer = layers[i];
    std::vector<tools::TowerBeads> tower;
    if (section < passes.tower.size() && passes.section_of[section] == i) {
      tower = tools::tower_beads(plate.tools, passes.size, passes.tower[section], section, passes.corner);
      ++section;
    }
    for (std::size_t p = passes.begin[i]; p < passes.begin[i + 1]; ++p) {
      const ToolId tool = passes.passes[p].tool;
      const bool first = p == passes.begin[i];
      travel::LayerInput input = layer;
      if (!first) input.time.comes_down = false;
      input.scope = tools.laid_over(layer.scope, tool, scopes);
      const auto keep = [&](Beads& beads) {
        std::erase_if(beads, [&](const Bead& bead) { return bead.tool == any_tool ? !first : bead.tool != tool; });
        for (auto& bead : beads)
          if (bead.tool == any_tool) give(bead, tool, tools, scopes);
      };
      keep(input.adhesion);
      for (auto& object : input.objects) {
        keep(object.beads);
        object.stack = object.stack * static_cast<std::uint32_t>(tools.count()) + tool;
      }
      const auto& own = tools.tools()[tool];
      const double d = to_mm(own.material.filament_diameter);
      input.filament_area_mm2 = 3.14159265358979323846 / 4 * d * d;
      input.nozzle = own.machine.nozzle_diameter;
      for (auto& [pass, beads] : tower) {
        if (pass != p) continue;
        for (auto& bead : beads) {
          bead.scope = layer.scope;
          give(bead, tool, tools, scopes);
        }
        input.adhesion.insert(first ? input.adhesion.end() : input.adhesion.begin(),
                              std::make_move_iterator(beads.begin()), std::make_move_iterator(beads.end()));
      }
      out.push_back(std::move(input));
    }
    layer = {};
  }
  return out;
}

std::vector<Step> change_before(const ToolPass& pass, const ToolScopes& tools, bool first_layer) {
  using Heater = SetTemperature::Heater;
  const auto& all = tools.tools();
  const auto celsius = [&](ToolId tool) {
    const auto& m = first_layer ? on_first_layer(all[tool]).material : all[tool].material;
    return m.material_print_temperature;
  };
  std::vector<Step> out;
  if (!pass.changes) return out;
  if (!pass.from) return {ToolChange{pass.tool}};  // the start G-code has heated
  out.emplace_back(Retract{.wipe = {}, .to_change = true});
  const bool shared = nozzle_of(all, *pass.from) == nozzle_of(all, pass.tool);
  if (!shared && pass.last_of_from) out.emplace_back(SetTemperature{Heater::nozzle, *pass.from, 0, false});
  out.emplace_back(ToolChange{pass.tool});
  if (shared) {
    if (celsius(*pass.from) != celsius(pass.tool))
      out.emplace_back(SetTemperature{Heater::nozzle, any_tool, celsius(pass.tool), true});
  } else {
    out.emplace_back(SetTemperature{Heater::nozzle, pass.tool, celsius(pass.tool), true});
  }
  return out;
}

}  // namespace weft::pipeline
