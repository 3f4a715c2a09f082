// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/passes.h"

#include "adhesion/adhesion.h"
#include "core/error.h"
#include "pipeline/add_raft.h"
#include "pipeline/at_heights.h"
#include "pipeline/change_tool.h"
#include "pipeline/gradients.h"
#include "pipeline/lagging_tower.h"
#include "pipeline/ooze_shield.h"
#include "pipeline/place_tower.h"
#include "pipeline/purge_into.h"
#include "pipeline/purge_pad.h"
#include "pipeline/room_around.h"
#include "settings/first_layer.h"
#include "settings/tools.h"
#include "tools/compatible.h"
#include "tools/order.h"
#include "tools/purge.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numbers>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

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
  std::size_t lies_in = 0;
  for (ScopeId id = 0; adhesion && id < scopes.size(); ++id)
    lies_in = std::max(lies_in, adhesion::layers_needed(adhesion_of(scopes[id].adhesion)));
  for (std::size_t i = 0; i < layers.size(); ++i) {
    const auto only = only_tool_at(plate.tools, layers[i].z);
    if (adhesion)
      for (auto& bead : layers[i].adhesion) give(bead, static_cast<ToolId>(*adhesion), tools, scopes);
    std::set<ToolId> found;
    if (layers[i].time.number < lies_in) found.insert(static_cast<ToolId>(*adhesion));  // it is not made yet
    for_each_bead(layers[i], [&](Bead& bead) {
      if (only && bead.tool != any_tool) give(bead, *only, tools, scopes);
      if (bead.tool != any_tool) found.insert(bead.tool);
    });
    out[i].assign(found.begin(), found.end());
  }
  return out;
}

/// All tools of the print have something to lay in its first layer.
void prime_all(tools::ToolSets& sets) {
  std::set<ToolId> used;
  for (const auto& set : sets) used.insert(set.begin(), set.end());
  sets.front().assign(used.begin(), used.end());
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
      out.passes.push_back({i, tool, loaded != tool, loaded, 0});
      loaded = tool;
    }
  }
  out.begin.push_back(out.passes.size());
  return out;
}

/// What each change is to purge.
void want_purging(const std::vector<Settings>& tools, Passes& passes) {
  const auto volumes = tools::purge_volumes(tools);
  for (auto& pass : passes.passes)
    if (pass.changes && pass.from) passes.purged.wanted_mm3 += pass.purge_mm3 = volumes[*pass.from][pass.tool];
}

/// What prints the tower's wall.
struct WallTool {
  bool purges = false;  ///< whichever purges most: filaments of one kind hold on each other
  ToolId tool = 0;
};
WallTool wall_tool(const std::vector<Settings>& tools, const Passes& passes) {
  if (const auto named = tools.front().tools.prime_tower_extruder_nr) return {false, static_cast<ToolId>(*named)};
  std::vector<std::size_t> layers(tools.size());
  for (const auto& pass : passes.passes) ++layers[pass.tool];
  WallTool out{true, passes.passes.front().tool};
  for (std::size_t i = 0; i < tools.size(); ++i) {
    if (layers[i] == 0) continue;
    const auto& own = tools[i];
    const auto& best = tools[out.tool];
    out.purges = out.purges && !own.tools.material_soluble && own.material.material_type == best.material.material_type;
    const bool holds = best.tools.material_soluble && !own.tools.material_soluble;
    if (holds || (layers[i] > layers[out.tool] && own.tools.material_soluble == best.tools.material_soluble))
      out.tool = static_cast<ToolId>(i);
  }
  return out;
}

/// Which pass of a section's layer prints its wall.
void choose_wall(const WallTool& wall, const Passes& passes, tools::TowerLayer& section, std::size_t layer) {
  section.wall_pass = passes.begin[layer];
  if (wall.purges) {
    double most = 0;
    for (const auto& strip : section.strips)
      if (!strip.ram && strip.pass >= passes.begin[layer] && strip.mm3 > most)
        most = strip.mm3, section.wall_pass = strip.pass, section.wall_purges = true;
    return;
  }
  for (std::size_t p = passes.begin[layer]; p < passes.begin[layer + 1]; ++p)
    if (passes.passes[p].tool == wall.tool) section.wall_pass = p;
}

/// Sections up to the last change: one a layer that purges, and between them where a bead would be too high.
void plan_tower(const std::vector<Settings>& tools, std::span<const travel::LayerInput> layers, Passes& passes) {
  const Um nozzle = least_nozzle(tools);
  const Um highest = rounded(highest_by_nozzle * nozzle);
  std::size_t last = 0;
  for (const auto& pass : passes.passes)
    if (pass.purge_mm3 > 0 || rammed_mm3(tools, pass) > 0) last = pass.layer + 1;
  const auto wall = wall_tool(tools, passes);
  const bool keeps_up = tools.front().tools.prime_tower_sparse;
  Um below = 0;  // the tower's top, or that of the layer that it has kept up with
  for (std::size_t i = 0; i < last; ++i) {
    tools::TowerLayer section{layers[i].z, layers[i].z - below, {}};
    if (!keeps_up) section.height = layers[i].height, section.z = below + layers[i].height;
    for (std::size_t p = passes.begin[i]; p < passes.begin[i + 1]; ++p) add_strips(tools, passes.passes[p], p, section);
    if (keeps_up && !passes.tower.empty() && tools::lay_beside(section, passes.tower.back(), highest, nozzle)) {
      below = layers[i].z;
      passes.section_of.back() = i;
      choose_wall(wall, passes, passes.tower.back(), i);
      continue;
    }
    const bool too_high = keeps_up && i + 1 < last && layers[i + 1].z - below > highest;
    if (section.strips.empty() && !too_high && i != 0) continue;
    below = section.z;
    choose_wall(wall, passes, section, i);
    passes.tower.push_back(std::move(section));
    passes.section_of.push_back(i);
  }
  passes.size = tools::tower_size(tools.front().tools, passes.tower, nozzle);
}

/// Filaments that follow each other in a nozzle mix where nothing is purged between them.
void tell_unpurged(const std::vector<Settings>& tools, const Passes& passes, Notices& notices) {
  std::size_t changes = 0;
  const ToolPass* first = nullptr;
  for (const auto& pass : passes.passes)
    if (pass.changes && pass.from && nozzle_of(tools, *pass.from) == nozzle_of(tools, pass.tool))
      if (changes++ == 0) first = &pass;
  if (first == nullptr) return;
  notices.push_back({"nothing_purged",
                     fmt::format("prime_tower_enable: it is off, {} and {} share a nozzle, and what is left of one is "
                                 "printed as the other: {} change{}",
                                 tools::name_of(tools, *first->from), tools::name_of(tools, first->tool), changes,
                                 changes == 1 ? "" : "s")});
}

/// The tools that print something, and how high.
std::vector<tools::ToolInUse> in_use(const tools::ToolSets& sets, std::span<travel::LayerInput> layers) {
  std::vector<tools::ToolInUse> out;
  const auto of = [&](ToolId tool) -> tools::ToolInUse& {
    const auto at = std::find_if(out.begin(), out.end(), [&](const auto& use) { return use.tool >= tool; });
    return at != out.end() && at->tool == tool ? *at : *out.insert(at, tools::ToolInUse{tool, 0});
  };
  for (std::size_t i = 0; i < sets.size(); ++i) {
    for (const ToolId tool : sets[i]) of(tool);
    for (const auto& object : layers[i].objects)
      for (const auto& bead : object.beads)
        if (bead.tool != any_tool) {
          auto& highest = of(bead.tool).highest;
          highest = std::max(highest, object.height != 0 ? object.height : layers[i].height);
        }
  }
  return out;
}

}  // namespace

Passes passes_of(const Settings& plate, ToolScopes& tools, Scopes& scopes, std::span<travel::LayerInput> layers,
                 Notices& notices) {
  Passes out;
  const auto told = [&](const std::vector<tools::ToolInUse>& use) {
    for (auto& notice : tools::compatibility(tools.tools(), use)) notices.push_back(std::move(notice));
  };
  if (!tools.several()) {
    told({{0, 0}});
    for (std::size_t i = 0; i <= layers.size(); ++i) out.begin.push_back(i);
    for (std::size_t i = 0; i < layers.size(); ++i) out.passes.push_back({i, any_tool, false, {}, 0});
    return out;
  }
  apply_gradients(tools, scopes, layers);
  auto sets = sets_of(plate, tools, scopes, layers);
  if (plate.tools.prime_line && !sets.empty()) prime_all(sets);
  told(in_use(sets, layers));
  out = in_order(tools::ordered(sets, costs_of(tools.tools()), plate.tools.tool_order));
  out.shield = ooze_shield(plate, layers, out);
  if (!out.shield.empty() && one_at_a_time(layers))
    throw Error{Error::Kind::settings, "it is a wall around all objects, and one is finished before the next begins",
                "ooze_shield_enabled", "ooze_shield_enabled = false, or print_sequence = all_at_once"};
  const bool changes =
      std::any_of(out.passes.begin(), out.passes.end(), [](const ToolPass& p) { return p.changes && p.from; });
  if (!changes) return out;
  if (!wants_tower(plate, tools)) {
    tell_unpurged(tools.tools(), out, notices);
    return out;
  }
  want_purging(tools.tools(), out);
  purge_into(tools, scopes, layers, out);
  if (one_at_a_time(layers)) {
    lay_pad(plate, tools.tools(), layers, out);
    return out;
  }
  plan_tower(tools.tools(), layers, out);
  if (out.has_tower()) {
    place_tower(plate, standing_on(plate, layers), out);
    check_lag(plate, out, layers);
  }
  return out;
}

Regions beside_objects(const Settings& plate, const Passes& passes) {
  // A brim goes within the shield.
  Regions out = plate.adhesion.adhesion_type == AdhesionType::brim ? Regions{} : passes.shield;
  if (passes.has_tower() && !passes.pad)
    out.insert(out.begin(), {tools::tower_outline(plate.tools, passes.size, passes.corner), {}});
  return out;
}

void give_adhesion(const Settings& plate, ToolScopes& tools, Scopes& scopes, std::span<travel::LayerInput> layers) {
  const auto& tool = plate.tools.adhesion_extruder_nr;
  if (!tools.several() || !tool) return;
  for (auto& layer : layers)
    for (auto& bead : layer.adhesion)
      if (bead.tool == any_tool) give(bead, static_cast<ToolId>(*tool), tools, scopes);
}

namespace {

std::array<Point, 2> first_piece(const Bead& bead) {
  return {bead.path.front().at, bead.path[bead.path.size() > 1 ? 1 : 0].at};
}

/// What of a layer one pass prints, all but what is purged before it.
travel::LayerInput beads_of_pass(const ToolPass& pass, bool first, ToolScopes& tools, Scopes& scopes,
                                 const travel::LayerInput& layer) {
  const ToolId tool = pass.tool;
  travel::LayerInput out = layer;
  if (!first) out.time.comes_down = false;
  out.scope = tools.laid_over(layer.scope, tool, scopes);
  const auto keep = [&](Beads& beads) {
    std::erase_if(beads, [&](const Bead& bead) { return bead.tool == any_tool ? !first : bead.tool != tool; });
    for (auto& bead : beads)
      if (bead.tool == any_tool) give(bead, tool, tools, scopes);
  };
  keep(out.adhesion);
  for (auto& object : out.objects) {
    keep(object.beads);
    object.stack = object.stack * static_cast<std::uint32_t>(tools.count()) + tool;
  }
  const auto& own = tools.tools()[tool];
  const double d = to_mm(own.material.filament_diameter);
  out.filament_area_mm2 = std::numbers::pi / 4 * d * d;
  out.nozzle = own.machine.nozzle_diameter;
  return out;
}

}  // namespace

std::vector<travel::LayerInput> split(Passes& passes, const Settings& plate, ToolScopes& tools, Scopes& scopes,
                                      std::vector<travel::LayerInput> layers) {
  if (!tools.several()) return layers;
  std::vector<travel::LayerInput> out;
  std::size_t section = 0;
  std::vector<tools::TowerBeads> tower;
  const auto lay_section = [&] {
    tower.clear();
    if (section < passes.tower.size())
      tower = tools::tower_beads(plate.tools, passes.size, passes.tower[section], section, passes.corner);
  };
  lay_section();
  for (std::size_t i = 0; i < layers.size(); ++i) {
    auto& layer = layers[i];
    const bool ends = section < passes.tower.size() && passes.section_of[section] == i;
    if (ends) passes.lag[i] = layer.z - passes.tower[section].z;
    for (std::size_t p = passes.begin[i]; p < passes.begin[i + 1]; ++p) {
      const bool first = p == passes.begin[i];
      auto input = beads_of_pass(passes.passes[p], first, tools, scopes, layer);
      const auto put = [&](Beads& beads) {
        // The other filament is out before anything else is laid.
        const bool before_skirt = !first || (passes.passes[p].changes && passes.passes[p].from);
        input.adhesion.insert(before_skirt ? input.adhesion.begin() : input.adhesion.end(),
                              std::make_move_iterator(beads.begin()), std::make_move_iterator(beads.end()));
      };
      if (const auto purged = passes.into.find(p); purged != passes.into.end()) {
        passes.entry.emplace(p, first_piece(purged->second.front()));
        put(purged->second);
      }
      for (auto& [pass, beads, ram, height] : tower) {
        if (pass != p || beads.empty()) continue;
        passes.entry.insert_or_assign(p, first_piece(beads.front()));
        if (ram) {
          passes.ram.emplace(p, Passes::Ram{std::move(beads.front()), height});
          continue;
        }
        const float higher = static_cast<float>(height) / static_cast<float>(layer.height);
        for (auto& bead : beads) {
          bead.scope = layer.scope;
          give(bead, passes.passes[p].tool, tools, scopes);
          for (auto& junction : bead.path) junction.flow *= higher;
        }
        put(beads);
      }
      out.push_back(std::move(input));
    }
    layer = {};
    if (ends) ++section, lay_section();
  }
  passes.into.clear();
  return out;
}

}  // namespace weft::pipeline
