// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/paint_object.h"

#include "geometry/boolean.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace weft::pipeline {
namespace {

/// What is narrower than this share of the nozzle is left to what surrounds it.
constexpr double least_by_nozzle = 0.5;

/// All that is printed of the object on a layer: paint inside of it is on no surface.
Regions outline_of(const Object& object, std::span<const std::vector<slice::Cut>* const> cuts, std::size_t layer) {
  Regions out;
  std::size_t parts = 0;
  for (std::size_t v = 0; v < cuts.size(); ++v) {
    const auto kind = object.volumes[v].kind;
    if ((kind != VolumeKind::model && kind != VolumeKind::negative) || layer >= cuts[v]->size()) continue;
    const auto& own = (*cuts[v])[layer].layer.regions;
    if (kind == VolumeKind::negative)
      out = geometry::subtract(out, own);
    else
      out = parts++ == 0 ? own : geometry::unite(out, own);
  }
  return out;
}

}  // namespace

bool is_painted(const Object& object) {
  return std::any_of(object.volumes.begin(), object.volumes.end(),
                     [](const Volume& volume) { return volume.kind == VolumeKind::tint; });
}

slice::PaintReach paint_reach(const Settings& settings) {
  const auto& shells = settings.shells;
  const auto through = [&](int layers, Um thickness) {
    return std::max(static_cast<Um>(std::min<std::int64_t>(
                        max_coord, static_cast<std::int64_t>(layers) * settings.layers.layer_height)),
                    thickness);
  };
  return {.depth = settings.tools.paint_depth,
          .roof = through(shells.top_layers, shells.top_thickness),
          .floor = through(shells.bottom_layers, shells.bottom_thickness),
          .least = rounded(least_by_nozzle * settings.machine.nozzle_diameter)};
}

std::vector<std::vector<slice::Cut>> paint_cuts(const Object& object, slice::PaintReach reach,
                                                std::span<const std::vector<slice::Cut>* const> cuts) {
  std::vector<std::vector<slice::Cut>> out(cuts.size());
  std::vector<Mesh> painted;
  std::vector<std::size_t> of;
  std::vector<slice::Plane> planes;
  for (std::size_t v = 0; v < cuts.size(); ++v) {
    if (object.volumes[v].kind == VolumeKind::tint) painted.push_back(object.volumes[v].mesh), of.push_back(v);
    if (object.volumes[v].kind != VolumeKind::model || cuts[v]->size() <= planes.size()) continue;
    planes.clear();
    for (const auto& cut : *cuts[v])
      planes.push_back({cut.layer.z, cut.layer.height, cut.layer.z - cut.layer.height + cut.layer.height / 2});
  }
  const slice::Paint paint(painted, planes, reach);
  auto areas = tasks::parallel_map(planes.size(), [&](std::size_t i) {
    return paint.touches(i) ? paint.areas(i, outline_of(object, cuts, i)) : std::vector<Regions>(painted.size());
  });
  for (std::size_t k = 0; k < of.size(); ++k)
    for (std::size_t i = 0; i < planes.size(); ++i) {
      slice::Cut cut;
      cut.layer = {planes[i].z, planes[i].height, std::move(areas[i][k])};
      out[of[k]].push_back(std::move(cut));
    }
  return out;
}

}  // namespace weft::pipeline
