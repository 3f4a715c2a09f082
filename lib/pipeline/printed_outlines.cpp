// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/printed_outlines.h"

#include "tasks/parallel.h"
#include "walls/walls.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace weft::pipeline {
namespace {

/// A layer whose areas have walls of their own.
class Layer {
 public:
  Layer(const HandedTo<Stage::walls>& handed, const Scopes& scopes, std::size_t index)
      : handed_(handed), scopes_(scopes), index_(index) {}

  bool moves(const Areas& areas) const {
    return std::any_of(areas.begin(), areas.end(), [&](const auto& area) {
      return walls::moves_outlines(of(area.scope), of(scopes_.above_first_layer(area.scope)));
    });
  }

  Regions moved(ScopeId scope, const SlicedLayer& layer) const {
    const auto& [walls, nozzle] = handed_[scope];
    return walls::outlines_of(walls, {.layer = layer,
                                      .index = index_,
                                      .nozzle_diameter = nozzle,
                                      .settings_above = &of(scopes_.above_first_layer(scope))});
  }

 private:
  const WallSettings& of(ScopeId scope) const {
    const auto& [walls, nozzle] = handed_[scope];
    return walls;
  }

  const HandedTo<Stage::walls>& handed_;
  const Scopes& scopes_;
  std::size_t index_;
};

Regions moved_apart(const Layer& layer, const Areas& areas, const SlicedLayer& sliced) {
  Regions out = sliced.regions, divided;
  std::size_t number = 0;
  for (const auto& area : areas)
    for (std::uint32_t k = 0; k < area.regions; ++k, ++number) {
      auto parts = layer.moved(area.scope, {sliced.z, sliced.height, {sliced.regions[number]}});
      if (parts.empty()) continue;  // nothing is printed there
      out[number] = std::move(parts.front());
      std::move(std::next(parts.begin()), parts.end(), std::back_inserter(divided));
    }
  std::move(divided.begin(), divided.end(), std::back_inserter(out));
  return out;
}

}  // namespace

void move_outlines(const HandedTo<Stage::walls>& handed, const Scopes& scopes, const std::vector<Areas>& areas,
                   ResultOf<Stage::slice>& cuts) {
  tasks::for_each_index(cuts.size(), [&](std::size_t i) {
    const Layer layer(handed, scopes, i);
    if (areas[i].empty() || !layer.moves(areas[i])) return;
    auto& sliced = cuts[i].layer;
    sliced.regions =
        areas[i].size() == 1 ? layer.moved(areas[i].front().scope, sliced) : moved_apart(layer, areas[i], sliced);
  });
}

}  // namespace weft::pipeline
