// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/wall_object.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "model/flow.h"
#include "overhangs/overhangs.h"
#include "pipeline/support_object.h"
#include "pipeline/told_apart.h"
#include "tasks/parallel.h"
#include "walls/walls.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace weft::pipeline {
namespace {

/// Rough walls hang on its corner, so they move with the object.
Point corner_of(const std::vector<slice::Cut>& cuts) {
  Box box;
  for (const auto& cut : cuts) box.add(box_of(cut.layer.regions));
  return box.min;
}

}  // namespace

WallsOfObject::WallsOfObject(const WallHands& handed, const Scopes& scopes, const std::vector<slice::Cut>& cuts,
                             const std::vector<Areas>& areas, const Sample& sample)
    : handed_(handed),
      scopes_(scopes),
      cuts_(cuts),
      areas_(areas),
      sample_(sample),
      origin_(corner_of(cuts)),
      ahead_(cuts.size()) {}

template <class Do>
void WallsOfObject::of_each(std::size_t layer, const Regions* over_air, std::vector<Piece>& pieces, Do what) const {
  const Regions* above = layer + 1 < cuts_.size() ? &cuts_[layer + 1].layer.regions : nullptr;
  for (Piece& piece : pieces) {
    const auto& [settings, nozzle] = handed_[piece.scope];
    const auto& [settings_above, nozzle_above] = handed_[scopes_.above_first_layer(piece.scope)];
    what(settings,
         walls::WallInput{.layer = piece.regions.empty() ? cuts_[layer].layer : piece.own,
                          .index = layer,
                          .nozzle_diameter = nozzle,
                          .over_air = over_air,
                          .above = above,
                          .settings_above = &settings_above,
                          .origin = origin_},
         piece.walls);
  }
}

std::vector<WallsOfObject::Piece> WallsOfObject::laid(std::size_t i) const {
  const SlicedLayer& layer = cuts_[i].layer;
  std::vector<Piece> out;
  if (areas_[i].size() == 1) {
    out.push_back({areas_[i].front().scope, {}, {}, {}});
  } else {
    for (auto& [scope, regions] : told_apart(handed_, areas_[i])) {
      Piece& piece = out.emplace_back(Piece{scope, std::move(regions), {layer.z, layer.height, {}}, {}});
      for (const std::uint32_t r : piece.regions) piece.own.regions.push_back(layer.regions[r]);
    }
  }
  of_each(i, nullptr, out, [](const WallSettings& settings, const walls::WallInput& input, WallLayer& walls) {
    walls = walls::lay(settings, input);
  });
  return out;
}

void WallsOfObject::lay_ahead(std::size_t layer) {
  if (sample_.has(layer)) ahead_[layer] = laid(layer);
}

std::vector<WallLayer> WallsOfObject::build(std::vector<Regions> known_over_air, const std::vector<Regions>& held) {
  return tasks::parallel_map(cuts_.size(), [&](std::size_t i) {
    WallLayer out;
    if (!sample_.has(i)) {
      out.inside = nominal_inside(handed_, areas_[i], cuts_[i].layer, i);
      return out;
    }
    Regions over_air = i < known_over_air.size() ? std::move(known_over_air[i]) : over_air_of(cuts_, i);
    if (i < held.size() && !held[i].empty()) over_air = geometry::subtract(over_air, held[i]);
    auto pieces = std::exchange(ahead_[i], {});
    if (pieces.empty()) pieces = laid(i);
    of_each(i, &over_air, pieces, walls::finish);
    for (Piece& piece : pieces) {
      WallLayer& own = piece.walls;
      if (!piece.regions.empty())
        for (auto& bead : own.beads)
          bead.part = piece.regions[std::min<std::size_t>(bead.part, piece.regions.size() - 1)];
      std::move(own.beads.begin(), own.beads.end(), std::back_inserter(out.beads));
      std::move(own.inside.begin(), own.inside.end(), std::back_inserter(out.inside));
      std::move(own.notices.begin(), own.notices.end(), std::back_inserter(out.notices));
    }
    out.over_air = overhangs::worth_keeping(std::move(over_air));
    return out;
  });
}

Regions nominal_inside(const WallHands& handed, const Areas& areas, const SlicedLayer& layer, std::size_t index) {
  const auto& [walls, nozzle] = handed[areas.front().scope];
  const int lines = walls.wall_line_count + (walls.alternate_extra_wall && index % 2 == 1 ? 1 : 0);
  if (lines == 0) return layer.regions;
  const auto band = [&layer, overlap = walls.overlap_factor](Um width) {
    return flow::spacing(width, layer.height, overlap);
  };
  const Um outer = band(length_or(walls.wall_line_width_0, nozzle, flow::automatic_outer_width(nozzle)));
  const Um inner = band(length_or(walls.wall_line_width_x, nozzle, flow::automatic_width(nozzle, layer.height)));
  return geometry::offset(layer.regions, {.by = -outer - (lines - 1) * inner});
}

}  // namespace weft::pipeline
