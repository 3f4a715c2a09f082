// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/inner_infill.h"

#include "geometry/boolean.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace weft::pipeline {

namespace {

bool solid(const Scopes& scopes, ScopeId id) {
  return scopes[id].infill.infill_sparse_density >= 100;
}

void make_solid(Regions sparse, infill::PartAreas& part) {
  if (!sparse.empty()) part.solid = geometry::unite(part.solid, sparse);
}

}  // namespace

std::vector<Regions> open_to_infill(const Scopes& scopes, const std::vector<Areas>& areas,
                                    const std::vector<const Regions*>& outlines) {
  bool any = false;
  for (const Areas& layer : areas)
    for (const Area& area : layer)
      for (const InnerArea& inner : area.inner) any = any || solid(scopes, inner.scope) != solid(scopes, area.scope);
  if (!any) return {};
  std::vector<Regions> out(areas.size());
  for (std::size_t i = 0; i < areas.size(); ++i) {
    auto from = outlines[i]->begin();
    for (const Area& area : areas[i]) {
      Regions own(from, from + area.regions);
      from += area.regions;
      const bool host = solid(scopes, area.scope);
      if (host) own.clear();
      for (const InnerArea& inner : area.inner)
        if (solid(scopes, inner.scope) != host)
          own = host ? geometry::unite(own, inner.regions) : geometry::subtract(own, inner.regions);
      std::move(own.begin(), own.end(), std::back_inserter(out[i]));
    }
  }
  return out;
}

std::vector<InnerInfill> take_inner(const Areas& areas, const Scopes& scopes, infill::LayerAreas& parts) {
  std::vector<InnerInfill> out;
  std::uint32_t first = 0;
  for (const Area& area : areas) {
    const auto of_area = [&](const infill::PartAreas& part) {
      return part.part >= first && part.part < first + area.regions && !part.sparse.empty();
    };
    for (const InnerArea& inner : area.inner) {
      auto& to = out.emplace_back(InnerInfill{inner.scope, {}});
      for (auto& part : parts) {
        if (!of_area(part)) continue;
        auto cut = geometry::cut(part.sparse, inner.regions);
        if (cut.inside.empty()) continue;
        part.sparse = std::move(cut.outside);
        if (solid(scopes, inner.scope)) {
          make_solid(std::move(cut.inside), part);
          continue;
        }
        infill::PartAreas own;
        own.part = part.part, own.sparse = std::move(cut.inside);
        to.parts.push_back(std::move(own));
      }
    }
    for (auto& part : parts)
      if (of_area(part) && solid(scopes, area.scope)) make_solid(std::exchange(part.sparse, {}), part);
    first += area.regions;
  }
  return out;
}

std::optional<std::vector<infill::LayerAreas>> with_inner(const std::vector<infill::LayerAreas>& parts,
                                                          const InnerLayers& inner) {
  if (std::all_of(inner.begin(), inner.end(), [](const auto& layer) { return layer.empty(); })) return std::nullopt;
  auto out = parts;
  for (std::size_t i = 0; i < out.size(); ++i)
    for (const auto& each : inner[i]) out[i].insert(out[i].end(), each.parts.begin(), each.parts.end());
  return out;
}

void put_behind(FillLayer filled, FillLayer& to) {
  std::uint32_t sequences = 0;
  for (const auto& bead : to.beads) sequences = std::max(sequences, bead.sequence);
  for (auto& bead : filled.beads)
    if (bead.sequence != 0) bead.sequence += sequences;
  std::move(filled.beads.begin(), filled.beads.end(), std::back_inserter(to.beads));
  std::move(filled.notices.begin(), filled.notices.end(), std::back_inserter(to.notices));
}

}  // namespace weft::pipeline
