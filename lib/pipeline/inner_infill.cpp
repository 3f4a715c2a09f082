// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/inner_infill.h"

#include "geometry/boolean.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace weft::pipeline {

std::vector<InnerInfill> take_inner(const Areas& areas, const Scopes& scopes, infill::LayerAreas& parts) {
  std::vector<InnerInfill> out;
  std::uint32_t first = 0;
  for (const Area& area : areas) {
    for (const InnerArea& inner : area.inner) {
      auto& to = out.emplace_back(InnerInfill{inner.scope, {}});
      for (auto& part : parts) {
        if (part.part < first || part.part >= first + area.regions || part.sparse.empty()) continue;
        auto cut = geometry::cut(part.sparse, inner.regions);
        if (cut.inside.empty()) continue;
        part.sparse = std::move(cut.outside);
        infill::PartAreas own;
        own.part = part.part;
        const bool solid = scopes[inner.scope].infill.infill_sparse_density >= 100;
        (solid ? own.solid : own.sparse) = std::move(cut.inside);
        to.parts.push_back(std::move(own));
      }
    }
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
