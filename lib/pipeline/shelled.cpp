// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/shelled.h"

#include "tasks/parallel.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <set>
#include <utility>

namespace weft::pipeline {
namespace {

/// What shells go by: of what is solid throughout, the first sparse infill inside of it.
ScopeId sparse_in(const Shelled& object, ScopeId id) {
  const auto solid = [&](ScopeId each) { return object.scopes[each].infill.infill_sparse_density >= 100; };
  if (object.open.empty() || !solid(id)) return id;
  for (const auto& layer : object.areas)
    for (const auto& area : layer)
      if (object.scope_of(area.scope) == id)
        for (const auto& inner : area.inner)
          if (!solid(inner.scope)) return object.scope_of(inner.scope);
  return id;
}

/// The different scopes of layers [first, first + count), as shells ask for them.
std::vector<ScopeId> scopes_asked(const Shelled& object, std::size_t first, std::size_t count) {
  std::vector<ScopeId> out;
  for (std::size_t i = first; i < first + count; ++i)
    for (const auto& area : object.areas[i])
      if (const ScopeId id = object.scope_of(area.scope); std::find(out.begin(), out.end(), id) == out.end())
        out.push_back(id);
  return out;
}

/// Takes out of a layer's parts those of one scope.
infill::LayerAreas taken(const Shelled& object, ScopeId id, std::size_t layer, infill::LayerAreas& parts) {
  std::vector<char> own;  // by part
  for (const auto& area : object.areas[layer]) own.resize(own.size() + area.regions, object.scope_of(area.scope) == id);
  const auto rest = std::stable_partition(parts.begin(), parts.end(), [&](const infill::PartAreas& part) {
    return part.part >= own.size() || own[part.part] == 0;
  });
  infill::LayerAreas out(std::make_move_iterator(rest), std::make_move_iterator(parts.end()));
  parts.erase(rest, parts.end());
  return out;
}

void put_back(infill::LayerAreas parts, infill::LayerAreas& to) {
  std::move(parts.begin(), parts.end(), std::back_inserter(to));
  std::sort(to.begin(), to.end(), [](const auto& a, const auto& b) { return a.part < b.part; });
}

/// What fills the inside of layers [first, first + count).
std::vector<infill::LayerAreas> find_areas(const Shelled& object, std::size_t first, std::size_t count) {
  const auto asked = scopes_asked(object, first, count);
  std::vector<infill::LayerAreas> out(count);
  for (const ScopeId id : asked) {
    const auto& [shells, infill, nozzle, width, overlap] = object.handed[sparse_in(object, id)];
    auto found = infill::find_areas(shells, infill, {object.layers, object.box, nozzle, overlap, object.turned_rad},
                                    first, count);
    if (asked.size() == 1) return found;
    for (std::size_t i = 0; i < count; ++i) put_back(taken(object, id, first + i, found[i]), out[i]);
  }
  return out;
}

/// What is decided of sparse parts of a scope by looking at all layers.
void look_at_all_of(const Shelled& object, ScopeId id, std::vector<infill::LayerAreas>& parts) {
  const auto& [shells, infill, nozzle, width, overlap] = object.handed[id];
  const infill::ShellObject shelled{object.layers, object.box, nozzle};
  infill::keep_below_tops(infill, shelled, parts);
  infill::combine_sparse(infill, shelled, parts);
}

}  // namespace

void look_at_all(const Shelled& object, std::vector<infill::LayerAreas>& areas) {
  const auto asked = scopes_asked(object, 0, areas.size());
  if (asked.size() == 1) return look_at_all_of(object, asked.front(), areas);
  for (const ScopeId id : asked) {
    std::vector<infill::LayerAreas> own;
    for (std::size_t i = 0; i < areas.size(); ++i) own.push_back(taken(object, id, i, areas[i]));
    look_at_all_of(object, id, own);
    for (std::size_t i = 0; i < areas.size(); ++i) put_back(std::move(own[i]), areas[i]);
  }
}

InnerLayers take_all_inner(const Shelled& object, std::vector<infill::LayerAreas>& areas) {
  InnerLayers out(areas.size());
  std::set<ScopeId> scopes;
  for (std::size_t i = 0; i < areas.size(); ++i) {
    out[i] = take_inner(object.areas[i], object.scopes, areas[i]);
    for (const auto& inner : out[i]) scopes.insert(object.scope_of(inner.scope));
  }
  for (const ScopeId id : scopes) {
    std::vector<infill::LayerAreas> own(areas.size());
    for (std::size_t i = 0; i < areas.size(); ++i)
      for (auto& inner : out[i])
        if (object.scope_of(inner.scope) == id) own[i] = std::move(inner.parts);
    look_at_all_of(object, id, own);
    for (std::size_t i = 0; i < areas.size(); ++i)
      for (auto& inner : out[i])
        if (object.scope_of(inner.scope) == id) inner.parts = std::move(own[i]);
  }
  return out;
}

std::vector<ScopeId> scopes_filling(const Shelled& object, const InnerLayers& inner) {
  auto out = scopes_asked(object, 0, object.areas.size());
  for (const auto& layer : inner)
    for (const auto& each : layer)
      if (const ScopeId id = object.scope_of(each.scope); std::find(out.begin(), out.end(), id) == out.end())
        out.push_back(id);
  return out;
}

std::vector<infill::LayerAreas> find_all_areas(const Shelled& object) {
  constexpr std::size_t run = 8;  // layers around it are looked at for each run as well
  const std::size_t count = object.layers.size(), runs = (count + run - 1) / run;
  // Whoever has the last one is waited for: those that take long are begun first.
  std::vector<std::size_t> corners(runs), order(runs);
  for (std::size_t i = 0; i < count; ++i)
    for (const Region& region : *object.layers[i].inside) {
      corners[i / run] += region.outer.size();
      for (const Ring& hole : region.holes) corners[i / run] += hole.size();
    }
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return corners[a] > corners[b]; });
  std::vector<infill::LayerAreas> areas(count);
  const auto find = [&](std::size_t k) {
    const std::size_t first = order[k] * run;
    return find_areas(object, first, std::min(run, count - first));
  };
  tasks::parallel_in_order(runs, find, [&](std::size_t k, std::vector<infill::LayerAreas> found) {
    std::move(found.begin(), found.end(), areas.begin() + static_cast<std::ptrdiff_t>(order[k] * run));
  });
  return areas;
}

}  // namespace weft::pipeline
