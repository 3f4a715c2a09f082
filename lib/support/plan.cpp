// SPDX-License-Identifier: GPL-3.0-or-later
#include "core/stop.h"
#include "geometry/boolean.h"
#include "geometry/clip_lines.h"
#include "geometry/nudge.h"
#include "geometry/simplify.h"
#include "geometry/trimmed.h"
#include "support/brackets.h"
#include "support/caps.h"
#include "support/cheaper.h"
#include "support/columns.h"
#include "support/kinds.h"
#include "support/landing.h"
#include "support/lengths.h"
#include "support/near_edge.h"
#include "support/resting.h"
#include "support/support.h"
#include "support/thin.h"
#include "support/towers.h"
#include "support/trapped.h"
#include "support/tree.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace weft::support {
namespace {

/// What is to be held from each level.
std::vector<Regions> contacts_of(const Stack& stack, const Demand& demand) {
  std::vector<Regions> out(stack.levels.size());
  for (std::size_t i = 0; i < demand.size(); ++i)
    if (stack.contacts[i].level != Stack::none) append(out[stack.contacts[i].level], demand[i].wanted);
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

/// Cuts columns into roof, bottom and what is between.
class Interfaces {
 public:
  Interfaces(const Room& room, const Stack& stack, const std::vector<Regions>& contacts)
      : room_(room),
        s_(room.settings()),
        stack_(stack),
        contacts_(contacts),
        line_(line_width(s_, room.object().nozzle)),
        caps_(lowest_caps(stack)) {}

  /// @param thinned  boxes of columns of which something had no room for a bead beside a roof: it is left out
  SupportLayer divided(std::size_t k, const Regions& standing, std::vector<Box>& thinned) const {
    const auto& level = stack_.levels[k];
    SupportLayer out{level.z, level.height, standing, {}, {}, {}, k == 0 && !room_.object().on_raft, {}};
    if (standing.empty()) return out;
    if (s_.support_roof_enable && s_.support_roof_height > 0) add_roof(k, standing, out);
    if (s_.support_bottom_enable && level.bottom() > room_.object().floor) {
      out.bottom = bottom(level, standing);
      for (const Regions* roof : {&out.roof, &out.under_roof})
        if (!roof->empty()) out.bottom = geometry::subtract(out.bottom, *roof);
    }
    Regions dense = out.roof, sparse;
    append(dense, out.under_roof), append(dense, out.bottom);
    if (dense.empty()) return out;
    for (Region& column : out.columns) {
      const Regions near = near_to(column, dense);
      if (near.empty())
        sparse.push_back(std::move(column));
      else if (near != Regions{column})
        for (const Region& left : geometry::beyond(column, near, beside_by)) {
          const Regions wide = without_thin({left}, thin_column(line_));
          if (area_mm2(left) - area_mm2(wide) > least_to_rest_mm2) thinned.push_back(box_of(left.outer));
          append(sparse, wide);
        }
    }
    out.columns = std::move(sparse);
    return out;
  }

 private:
  /// Of each roof the lowest level is strands that its own lie across. A narrow one lies on the walls of its column,
  /// and on rungs between them.
  void add_roof(std::size_t k, const Regions& standing, SupportLayer& out) const {
    Regions held, lowest;
    for (std::size_t j = k; j < stack_.levels.size(); ++j) {
      if (stack_.levels[j].bottom() >= stack_.levels[k].z + s_.support_roof_height + 2 * room_.object().nozzle) break;
      if (contacts_[j].empty()) continue;
      const std::size_t levels = roof_levels(stack_, j, caps_[j], s_.support_roof_height);
      if (j - k < levels) append(j - k + 1 < levels ? held : lowest, contacts_[j]);
    }
    if (held.size() > 1) held = geometry::unite(held);
    if (!held.empty()) {
      thicken(held, held, line_);
      out.roof = geometry::intersect(standing, held);
    }
    if (lowest.empty()) return;
    if (!out.roof.empty()) lowest = geometry::subtract(lowest, out.roof);
    lowest = without_thin(lowest, narrow_roof / 2);
    if (!lowest.empty()) out.under_roof = geometry::intersect(standing, lowest);
  }
  Regions bottom(const Stack::Level& level, const Regions& standing) const {
    const Um height = s_.support_bottom_height.value_or(s_.support_roof_height), low = level.bottom() - bottom_gap(s_);
    if (height <= 0) return {};
    const Regions part = room_.part(low - std::max(height - level.height, 1), low, box_of(standing));
    return part.empty() ? part : geometry::intersect(standing, part);
  }

  const Room& room_;
  const SupportSettings& s_;
  const Stack& stack_;
  const std::vector<Regions>& contacts_;
  Um line_;
  std::vector<Um> caps_;
};

/// The first level is floors, also under branches, which are hollow above; and reaches further out, so that it sticks.
void spread_first(const Room& room, const Stack& stack, SupportLayer& first) {
  const auto& object = room.object();
  if (object.on_raft) return;
  Regions all = first.columns;
  append(all, first.roof), append(all, first.under_roof), append(all, first.bottom);
  Regions wide = all.empty() ? all : grown(geometry::unite(all), room.settings().support_brim_width);
  append(all, first.branches);  // which have a foot of their own
  if (all.empty()) return;
  if (!wide.empty()) wide = room.free_part(wide, stack.levels.front(), {});
  append(wide, all);  // what leans towards contacts is nearer to the part
  wide = geometry::unite(wide);
  Regions dense = first.roof;
  append(dense, first.bottom);
  first.columns = dense.empty() ? wide : geometry::subtract(wide, dense);
  first.branches.clear(), first.under_roof.clear();
}

/// What is wanted, by how much of it support is near to.
struct Near {
  Regions whole, partly;
  double contact_mm2 = 0;  ///< that support lies right under
};

Near by_nearness(const Regions& all_wanted, const Regions& support) {
  Near out;
  for (const Region& wanted : all_wanted) {
    const Regions under = near_to(wanted, support);
    if (under.empty()) {
      out.partly.push_back(wanted);
      continue;
    }
    const Regions beside = geometry::beyond(wanted, under, beside_by);
    out.contact_mm2 += area_mm2(wanted) - area_mm2(beside);
    (are_reached(wanted, beside, reached) ? out.whole : out.partly).push_back(wanted);
  }
  return out;
}

/// What is held of each layer of the object, and what is not.
void note_reached(const Object& object, const Stack& stack, const Demand& demand, const Caps& caps, Plan& plan) {
  struct Reached {
    Regions held;
    double needed_mm2 = 0, left_mm2 = 0, contact_mm2 = 0;
    Point left_at;
  };
  const auto of_layer = tasks::parallel_map(demand.size(), [&](std::size_t i) {
    Reached out;
    if (demand[i].wanted.empty()) return out;
    out.needed_mm2 = area_mm2(demand[i].wanted);
    const auto& contact = stack.contacts[i];
    // What hangs above the bed, or the raft, by no more than its gap and a layer lies down on it.
    if (contact.level == Stack::none) return out;
    Regions all = all_areas(plan.layers[contact.level]);
    append(all, caps.of[i]);
    const Near near = by_nearness(demand[i].wanted, all);
    out.contact_mm2 = near.contact_mm2;
    // It is a judgement of reach: finer corners do not matter to it.
    constexpr Um coarse = 100;
    const auto around = [](const Regions& areas) { return grown(geometry::coarsened(areas, coarse), reached, coarse); };
    Regions left, wide = around(near.whole);
    if (!near.partly.empty()) {
      const Regions beside = around(geometry::trimmed(all, box_of(near.partly).grown(2 * reached)));
      left = geometry::opening(geometry::subtract(near.partly, beside), coarse);
      append(wide, beside);
    }
    if (!wide.empty())
      out.held = geometry::intersect(
          geometry::trimmed(object.layers[i]->regions, box_of(demand[i].wanted).grown(reached)), wide);
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

bool all_empty(const std::vector<Regions>& by_level) {
  return std::all_of(by_level.begin(), by_level.end(), [](const Regions& regions) { return regions.empty(); });
}

/// By what is asked for.
Split split_of(const Room& room, const Stack& stack, const std::vector<Regions>& contacts, tasks::Spare& spare) {
  const std::vector<Regions> nothing(contacts.size());
  if (all_empty(contacts)) return {nothing, nothing, std::nullopt};
  switch (room.settings().support_structure) {
    case SupportStructure::normal:
      return {nothing, contacts, std::nullopt};
    case SupportStructure::tree:
      return {contacts, nothing, Field(room.settings(), room.object(), stack, contacts)};
    case SupportStructure::hybrid:
      break;
  }
  return cheaper(room, stack, contacts, spare);
}

Standing stand(const Room& room, const Stack& stack, const std::vector<Regions>& contacts,
               const std::vector<Regions>& given, tasks::Spare& spare) {
  const std::size_t count = contacts.size();
  Standing out;
  auto [towers, others] = for_towers(room.settings(), contacts);
  Split split = split_of(room, stack, others, spare);
  if (all_empty(split.for_branches)) {
    out.under_columns = contacts;
    const Patches* const known = split.patches && all_empty(towers) ? &*split.patches : nullptr;
    out.columns = columns(room, stack, contacts, given, spare, known);
    return out;
  }
  out.branches = tree(room, stack, *split.field, split.for_branches);
  out.under_columns = std::move(split.for_columns);
  auto left = left_by(out.branches, split.for_branches);
  hang_on(room, stack, split.for_branches, out.branches.areas, left);
  for (std::size_t k = 0; k < count; ++k) {
    if (left[k].empty() && towers[k].empty()) continue;
    append(out.under_columns[k], left[k]), append(out.under_columns[k], towers[k]);
    out.under_columns[k] = geometry::unite(out.under_columns[k]);
  }
  out.columns = columns(room, stack, out.under_columns, given, spare);
  return out;
}

/// What of one thing is not where another is, for its beads.
Regions beside(const Regions& what, const Regions& other, Um apart, Um thin) {
  Regions out;
  for (const Region& region : what) {
    const Regions near = geometry::trimmed(other, box_of(region.outer).grown(apart + 1));
    if (near.empty())
      out.push_back(region);
    else
      append(out, opened(geometry::subtract({region}, grown(near, apart)), thin));
  }
  return out;
}

/// Branches and their roofs, where no columns are.
void add_branches(const Room& room, std::size_t k, const Standing& standing, SupportLayer& layer) {
  const Um half = line_width(room.settings(), room.object().nozzle) / 2;
  const Regions &areas = standing.branches.areas[k], &roofs = standing.branches.roofs[k],
                &columns = standing.columns[k];
  if (!roofs.empty()) {
    const Regions own = beside(roofs, columns, 20, half / 2);
    append(layer.roof, own);
    if (layer.roof.size() > own.size()) layer.roof = geometry::unite(layer.roof);
  }
  layer.joists = standing.branches.joists[k];
  if (!layer.joists.area.empty() && !columns.empty()) {
    layer.joists.area = beside(layer.joists.area, columns, 20, half / 2);
    layer.joists.rimmed = beside(layer.joists.rimmed, columns, 20, half / 2);
    for (auto* lines : {&layer.joists.lines, &layer.joists.after}) {
      std::vector<Polyline> left;
      for (auto& piece : geometry::clip_lines(*lines, columns, geometry::Keep::outside))
        if (length_of(piece.line) >= 2 * half) left.push_back(std::move(piece.line));
      *lines = std::move(left);
    }
  }
  layer.branches = beside(areas, columns, half, half / 2);
  Regions others = roofs;
  append(others, layer.joists.area);
  layer.branches = beside(layer.branches, others, 0, half / 2);
}

/// What stood on what was left out of columns has nothing below.
/// @param thinned  by level, where: and what falls there itself leaves more out
void let_columns_rest(const Room& room, const Stack& stack, std::vector<std::vector<Box>> thinned,
                      std::vector<SupportLayer>& layers) {
  for (std::size_t k = 1; k < layers.size(); ++k) {
    const auto& less = thinned[k - 1];
    if (less.empty()) continue;
    stop_if_asked();
    const Regions below = all_areas(layers[k - 1]);
    Regions left;
    for (Region& region : layers[k].columns) {
      const Box box = box_of(region.outer);
      Regions one{std::move(region)};
      if (std::any_of(less.begin(), less.end(), [&](const Box& there) { return there.overlaps(box); })) {
        const double mm2 = area_mm2(one);
        rest_on(room, stack.levels[k], below, one);
        if (mm2 - area_mm2(one) > least_to_rest_mm2) thinned[k].push_back(box);
      }
      append(left, one);
    }
    layers[k].columns = std::move(left);
  }
}

/// What rests right on columns of a level: what they hold, what was drawn as support, and branches that come down
/// there.
Regions carried_on(std::size_t k, const Standing& standing, const std::vector<Regions>& given) {
  if (standing.columns[k].empty()) return {};
  Regions out = standing.under_columns[k];
  append(out, given[k]);
  if (k + 1 < standing.branches.areas.size() && !standing.branches.areas[k + 1].empty())
    append(out, geometry::intersect(standing.branches.areas[k + 1], standing.columns[k]));
  return out;
}

/// Where columns or roofs took the place of branches, those above may have nothing left below them.
void let_branches_rest(const Room& room, const Stack& stack, const Standing& standing,
                       std::vector<SupportLayer>& layers) {
  for (std::size_t k = 1; k < layers.size(); ++k) {
    const SupportLayer& below = layers[k - 1];
    if (layers[k].branches.empty()) continue;
    if (standing.columns[k - 1].empty() && below.roof.empty() && below.joists.area.empty()) continue;
    stop_if_asked();
    rest_on(room, stack.levels[k], all_areas(below), layers[k].branches);
  }
}

}  // namespace

Plan plan(const SupportSettings& settings, const Object& object, const Demand& demand) {
  tasks::Spare none;
  return plan(settings, object, demand, none);
}

Plan plan(const SupportSettings& settings, const Object& object, const Demand& demand, tasks::Spare& spare) {
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
  for (auto& contact : stack.contacts)
    if (contact.level >= used) contact = {};
  const Room room(settings, object);
  const Standing standing = stand(room, stack, contacts, given, spare);
  out.figures.tips = standing.branches.tips_at.size(), out.figures.trunks = standing.branches.trunks;
  out.figures.slenderest = standing.branches.slenderest;
  const Interfaces interfaces(room, stack, standing.under_columns);
  std::vector<std::vector<Box>> thinned(used);
  out.layers = tasks::parallel_map(used, [&](std::size_t k) {
    stop_if_asked();
    auto layer = interfaces.divided(k, standing.columns[k], thinned[k]);
    if (settings.gradual_support_infill_steps > 0) layer.carried = carried_on(k, standing, given);
    if (k < standing.branches.areas.size()) add_branches(room, k, standing, layer);
    return layer;
  });
  spare.beside([&] {
    let_columns_rest(room, stack, std::move(thinned), out.layers);
    let_branches_rest(room, stack, standing, out.layers);
  });
  if (used > 0) spread_first(room, stack, out.layers[0]);
  Caps caps = caps_on(room, stack, demand, out.layers);
  note_reached(object, stack, demand, caps, out);
  out.figures.on_part_mm2 = land(room, out.layers);
  if (settings.gradual_support_infill_steps > 0)
    for (SupportLayer& cap : caps.layers) cap.carried = cap.columns;
  std::move(caps.layers.begin(), caps.layers.end(), std::back_inserter(out.layers));
  std::stable_sort(out.layers.begin(), out.layers.end(),
                   [](const SupportLayer& a, const SupportLayer& b) { return a.z < b.z; });
  spare.beside([&] { out.trapped = trapped_shares(room, out.layers, out.figures.on_part_mm2); });
  return out;
}

}  // namespace weft::support
