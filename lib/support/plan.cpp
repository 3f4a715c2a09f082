// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "geometry/boolean.h"
#include "support/cheaper.h"
#include "support/columns.h"
#include "support/lengths.h"
#include "support/support.h"
#include "support/tree.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>

namespace weft::support {
namespace {

constexpr Um reached = 1.5_mm;  // what lies no further beside support does not sag between

/// What is to be held from each level.
std::vector<Regions> contacts_of(const Stack& stack, const Demand& demand) {
  std::vector<Regions> out(stack.levels.size());
  for (std::size_t i = 0; i < demand.size(); ++i)
    if (stack.contact[i] != Stack::none) append(out[stack.contact[i]], demand[i].wanted);
  for (auto& regions : out)
    if (regions.size() > 1) regions = geometry::unite(regions);
  return out;
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

/// How many levels from k on an interface of that height takes.
std::size_t levels_of(const Stack& stack, std::size_t k, Um height) {
  return std::max<std::size_t>(
      1, static_cast<std::size_t>(std::lround(static_cast<double>(height) / stack.levels[k].height)));
}

/// Cuts a level's columns into roof, bottom and what is between.
SupportLayer divided(const SupportSettings& s, const Object& object, const Stack& stack, std::size_t k,
                     const std::vector<Regions>& standing, const std::vector<Regions>& contacts) {
  const auto& level = stack.levels[k];
  const Um line = line_width(s, object.nozzle);
  SupportLayer out{level.z, level.height, standing[k], {}, {}, {}, k == 0 && !object.on_raft};
  if (out.columns.empty()) return out;
  if (s.support_roof_enable && s.support_roof_height > 0) {
    Regions held;
    const std::size_t end = std::min(stack.levels.size(), k + levels_of(stack, k, s.support_roof_height));
    for (std::size_t j = k; j < end; ++j) append(held, contacts[j]);
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

/// The first level reaches further out, so that it sticks.
void spread_first(const SupportSettings& s, const Object& object, const KeepOut& keep_out, SupportLayer& first) {
  if (s.support_brim_width <= 0 || object.on_raft) return;
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
    double needed_mm2 = 0, left_mm2 = 0;
    Point left_at;
  };
  const auto of_layer = tasks::parallel_map(demand.size(), [&](std::size_t i) {
    Reached out;
    if (demand[i].wanted.empty()) return out;
    out.needed_mm2 = area_mm2(demand[i].wanted);
    Regions left = demand[i].wanted;
    if (stack.contact[i] != Stack::none) {
      const auto& level = plan.layers[stack.contact[i]];
      Regions all = level.roof;
      append(all, level.columns), append(all, level.branches);
      const Regions wide = grown(geometry::unite(all), reached);
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
    plan.figures.bridged_mm2 += demand[i].bridged_mm2;
    if (of_layer[i].left_mm2 > 0.01 && plan.figures.left_mm2 <= 0.01)
      plan.figures.left_at = {of_layer[i].left_at.x, of_layer[i].left_at.y,
                              object.layers[i]->z - object.layers[i]->height};
    plan.figures.left_mm2 += of_layer[i].left_mm2;
  }
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
  Stack stack = stack_of(settings, object);
  const auto contacts = contacts_of(stack, demand);
  auto given = given_on(object, stack);
  std::size_t used = contacts.size();
  while (used > 0 && contacts[used - 1].empty() && given[used - 1].empty()) --used;
  stack.levels.resize(used);
  const auto keep_out = keep_outs(settings, object, stack);
  Tree branches;
  std::vector<Regions> under_columns = contacts;  // what they hold
  if (settings.support_structure != SupportStructure::normal && used > 0) {
    const auto split = settings.support_structure == SupportStructure::hybrid
                           ? cheaper(settings, object, stack, keep_out, contacts)
                           : Split{contacts, std::vector<Regions>(contacts.size())};
    branches = tree(settings, object, stack, keep_out, split.for_branches);
    under_columns = split.for_columns;
    const auto left = tasks::parallel_map(used, [&](std::size_t k) {
      if (split.for_branches[k].empty()) return Regions{};
      return geometry::opening(geometry::subtract(split.for_branches[k], grown(branches.areas[k], reached)), 50);
    });
    for (std::size_t k = 0; k < used; ++k)
      if (!left[k].empty()) {
        append(under_columns[k], left[k]);
        under_columns[k] = geometry::unite(under_columns[k]);
      }
    out.figures.tips = branches.tips_at.size(), out.figures.trunks = branches.trunks;
  }
  const auto standing = columns(settings, object, stack, keep_out, under_columns, given);
  out.layers = tasks::parallel_map(used, [&](std::size_t k) {
    auto layer = divided(settings, object, stack, k, standing, under_columns);
    if (k < branches.areas.size() && !branches.areas[k].empty())
      layer.branches =
          geometry::subtract(branches.areas[k], grown(standing[k], line_width(settings, object.nozzle) / 2));
    return layer;
  });
  if (used > 0) spread_first(settings, object, keep_out[0], out.layers[0]);
  note_reached(object, stack, demand, out);
  return out;
}

}  // namespace weft::support
