// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/simplify.h"
#include "support/cheaper.h"
#include "support/columns.h"
#include "support/joists.h"
#include "support/landing.h"
#include "support/lengths.h"
#include "support/support.h"
#include "support/tree.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>

namespace weft::support {
namespace {

/// What is to be held from each level.
std::vector<Regions> contacts_of(const Stack& stack, const Demand& demand) {
  std::vector<Regions> out(stack.levels.size());
  for (std::size_t i = 0; i < demand.size(); ++i)
    if (stack.contact[i] != Stack::none) append(out[stack.contact[i]], demand[i].wanted);
  return tasks::parallel_map(out.size(), [&](std::size_t k) {
    if (out[k].empty()) return Regions{};
    return geometry::simplified(out[k].size() > 1 ? geometry::unite(out[k]) : out[k], coarse_outline);
  });
}

/// What was drawn as support, by level.
std::vector<Regions> given_on(const Object& object, const Stack& stack) {
  std::vector<Regions> out(stack.levels.size());
  if (object.given.empty()) return out;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const auto& level = stack.levels[k];
    const auto run = layers_between(object, (level.z + level.bottom()) / 2 - 1, (level.z + level.bottom()) / 2 + 1);
    for (std::size_t i = run.from; i < run.to && i < object.given.size(); ++i) append(out[k], object.given[i]);
    if (run.to - run.from > 1) out[k] = geometry::unite(out[k]);
  }
  return out;
}

/// Cuts a level's columns into roof, bottom and what is between.
SupportLayer divided(const SupportSettings& s, const Object& object, const Stack& stack, std::size_t k,
                     const std::vector<Regions>& standing, const std::vector<Regions>& contacts) {
  const auto& level = stack.levels[k];
  const Um line = line_width(s, object.nozzle);
  SupportLayer out{level.z, level.height, standing[k], {}, {}, {}, k == 0 && !object.on_raft, {}};
  if (out.columns.empty()) return out;
  if (s.support_roof_enable && s.support_roof_height > 0) {
    Regions held;
    for (std::size_t j = k; j < stack.levels.size(); ++j) {
      if (stack.levels[j].bottom() >= level.z + s.support_roof_height + 2 * object.nozzle) break;
      if (!contacts[j].empty() && j - k < interface_levels(stack, j, s.support_roof_height)) append(held, contacts[j]);
    }
    if (!held.empty()) out.roof = geometry::intersect(out.columns, grown(geometry::unite(held), line));
  }
  if (s.support_bottom_enable && level.bottom() > object.floor) {
    const Um height = s.support_bottom_height.value_or(s.support_roof_height);
    const Um low = level.bottom() - bottom_gap(s);
    const Regions part = outlines_between(object, low - std::max(height - level.height, 1), low);
    if (height > 0 && !part.empty()) out.bottom = geometry::intersect(out.columns, part);
    if (!out.roof.empty()) out.bottom = geometry::subtract(out.bottom, out.roof);
  }
  if (!out.roof.empty() || !out.bottom.empty()) {
    Regions dense = out.roof;
    append(dense, out.bottom);
    out.columns = geometry::opening(geometry::subtract(out.columns, dense), line * 4 / 10);
  }
  return out;
}

/// The first level is floors, also under branches, which are hollow above; and reaches further out, so that it sticks.
void spread_first(const SupportSettings& s, const Object& object, const KeepOut& keep_out, SupportLayer& first) {
  if (object.on_raft) return;
  Regions all = first.columns;
  append(all, first.roof), append(all, first.bottom);
  Regions wide = all.empty() ? all : grown(geometry::unite(all), s.support_brim_width);
  append(wide, first.branches);  // which have a foot of their own
  if (wide.empty()) return;
  wide = geometry::unite(wide);
  if (object.room != nullptr) wide = geometry::intersect(wide, *object.room);
  Regions barred = keep_out.near;
  append(barred, keep_out.over), append(barred, first.roof), append(barred, first.bottom);
  first.columns = geometry::subtract(wide, barred);
  first.branches.clear();
}

void note_reached(const Object& object, const Stack& stack, const Demand& demand, Plan& plan) {
  struct Reached {
    Regions held;
    double needed_mm2 = 0, left_mm2 = 0, contact_mm2 = 0;
    Point left_at;
  };
  const auto of_layer = tasks::parallel_map(demand.size(), [&](std::size_t i) {
    Reached out;
    if (demand[i].wanted.empty()) return out;
    out.needed_mm2 = area_mm2(demand[i].wanted);
    Regions left = demand[i].wanted;
    if (stack.contact[i] != Stack::none) {
      const auto& level = plan.layers[stack.contact[i]];
      const Box near = box_of(demand[i].wanted).grown(2 * reached);
      Regions all;
      for (const Regions* some : {&level.roof, &level.columns, &level.branches})
        for (const Region& region : *some)
          if (near.overlaps(box_of(region.outer))) all.push_back(region);
      all = geometry::unite(all);
      out.contact_mm2 = area_mm2(geometry::intersect(all, demand[i].wanted));
      const Regions wide = grown(all, reached);
      out.held = geometry::intersect(wide, object.layers[i]->regions);
      left = geometry::opening(geometry::subtract(left, wide), 20);
    }
    out.left_mm2 = area_mm2(left);
    if (!left.empty()) out.left_at = left.front().outer.front();
    return out;
  });
  for (std::size_t i = 0; i < of_layer.size(); ++i) {
    plan.held[i] = of_layer[i].held;
    plan.figures.needed_mm2 += of_layer[i].needed_mm2;
    plan.figures.contact_mm2 += of_layer[i].contact_mm2;
    plan.figures.islands += demand[i].islands;
    plan.figures.bridged_mm2 += demand[i].bridged_mm2;
    if (of_layer[i].left_mm2 > 0.01 && plan.figures.left_mm2 <= 0.01)
      plan.figures.left_at = {of_layer[i].left_at.x, of_layer[i].left_at.y,
                              object.layers[i]->z - object.layers[i]->height};
    plan.figures.left_mm2 += of_layer[i].left_mm2;
  }
}

/// What stands under the contacts.
struct Standing {
  Tree branches;
  std::vector<Regions> columns;
  std::vector<Regions> under_columns;  ///< by level: the contacts that columns hold
};

/// What of contacts branches left, by level.
std::vector<Regions> left_by(const Tree& branches, const std::vector<Regions>& contacts) {
  return tasks::parallel_map(contacts.size(), [&](std::size_t k) {
    if (contacts[k].empty()) return Regions{};
    Regions held = branches.areas[k];
    append(held, branches.roofs[k]);
    return geometry::opening(geometry::subtract(contacts[k], grown(geometry::unite(held), reached)), 50);
  });
}

Standing stand(const SupportSettings& s, const Object& object, const Stack& stack, const std::vector<KeepOut>& keep_out,
               const std::vector<Regions>& contacts, const std::vector<Regions>& given) {
  const std::size_t count = contacts.size();
  Standing out;
  if (s.support_structure == SupportStructure::normal || count == 0) {
    out.under_columns = contacts;
    out.columns = columns(s, object, stack, keep_out, contacts, given);
    return out;
  }
  auto [towers, others] = for_towers(s, contacts);
  Split split;
  if (s.support_structure == SupportStructure::hybrid)
    split = cheaper(s, object, stack, keep_out, others);
  else
    split = {others, std::vector<Regions>(count), std::nullopt};
  out.branches = split.branches ? std::move(*split.branches) : tree(s, object, stack, keep_out, split.for_branches);
  out.under_columns = std::move(split.for_columns);
  const auto left = left_by(out.branches, split.for_branches);
  for (std::size_t k = 0; k < count; ++k) {
    if (left[k].empty() && towers[k].empty()) continue;
    append(out.under_columns[k], left[k]), append(out.under_columns[k], towers[k]);
    out.under_columns[k] = geometry::unite(out.under_columns[k]);
  }
  out.columns = columns(s, object, stack, keep_out, out.under_columns, given);
  return out;
}

/// Branches and their roofs, where no columns are.
void add_branches(const SupportSettings& s, const Object& object, std::size_t k, const Standing& standing,
                  SupportLayer& layer) {
  const Um half = line_width(s, object.nozzle) / 2;
  const Regions &areas = standing.branches.areas[k], &roofs = standing.branches.roofs[k];
  if (!roofs.empty()) {
    Regions own = standing.columns[k].empty() ? roofs : geometry::subtract(roofs, grown(standing.columns[k], 20));
    own = geometry::opening(own, half / 2);
    append(layer.roof, own);
    if (layer.roof.size() > own.size()) layer.roof = geometry::unite(layer.roof);
  }
  layer.joists = standing.branches.joists[k];
  if (!layer.joists.area.empty() && !standing.columns[k].empty()) {
    layer.joists.area =
        geometry::opening(geometry::subtract(layer.joists.area, grown(standing.columns[k], 20)), half / 2);
    clip_joists(layer.joists, 2 * half);
  }
  if (areas.empty()) return;
  Regions others = grown(standing.columns[k], half);
  append(others, roofs), append(others, layer.joists.area);
  layer.branches = others.empty() ? areas : geometry::opening(geometry::subtract(areas, others), half / 2);
}

}  // namespace

Plan plan(const SupportSettings& settings, const Object& object, const Demand& demand) {
  Plan out;
  out.held.resize(object.layers.size());
  for (const auto& layer : demand) out.figures.bridged_mm2 += layer.wanted.empty() ? layer.bridged_mm2 : 0;
  const auto nothing = [](const Regions& regions) { return regions.empty(); };
  if (std::all_of(demand.begin(), demand.end(), [](const LayerDemand& d) { return d.wanted.empty(); }) &&
      std::all_of(object.given.begin(), object.given.end(), nothing))
    return out;
  out.figures = {};
  Stack stack = stack_of(settings, object, demand);
  const auto contacts = contacts_of(stack, demand);
  auto given = given_on(object, stack);
  std::size_t used = contacts.size();
  while (used > 0 && contacts[used - 1].empty() && given[used - 1].empty()) --used;
  stack.levels.resize(used);
  const auto keep_out = keep_outs(settings, object, stack);
  const Standing standing = stand(settings, object, stack, keep_out, contacts, given);
  out.figures.tips = standing.branches.tips_at.size(), out.figures.trunks = standing.branches.trunks;
  out.figures.slenderest = standing.branches.slenderest;
  out.layers = tasks::parallel_map(used, [&](std::size_t k) {
    auto layer = divided(settings, object, stack, k, standing.columns, standing.under_columns);
    if (k < standing.branches.areas.size()) add_branches(settings, object, k, standing, layer);
    return layer;
  });
  if (used > 0) spread_first(settings, object, keep_out[0], out.layers[0]);
  note_reached(object, stack, demand, out);
  out.figures.on_part_mm2 = land(settings, object, out.layers);
  return out;
}

}  // namespace weft::support
