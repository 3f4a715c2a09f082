// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/slice_object.h"

#include "pipeline/counterbores.h"
#include "pipeline/key_bytes.h"
#include "pipeline/layer_heights.h"
#include "pipeline/paint_object.h"
#include "pipeline/weave.h"
#include "slice/slice.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

/// How high what is printed of the object reaches.
Um top_of(const Object& object) {
  Um out = 0;
  for (const auto& volume : object.volumes)
    if (volume.kind == VolumeKind::model) out = std::max(out, box_of(volume.mesh).max.z);
  return out;
}

/// The heights of layers hang on all volumes of an object: they are in the key themselves.
StageKey slice_key(const Mesh& mesh, const std::vector<slice::Plane>& planes, const ObjectScopes& scopes,
                   const SliceHands& handed) {
  auto key = key_of<Stage::slice>(scopes, handed).with(sha256(bytes_of(mesh)));
  for (const auto& plane : planes) key.with(plane.z).with(plane.height).with(plane.below);
  return key;
}

slice::PaintReach reach_of(const Scopes& all_scopes, const ObjectScopes& scopes) {
  return paint_reach(all_scopes[scopes.back().of_mix.front()]);
}

Cuts slice_mesh(const SliceHands& handed, const ObjectScopes& scopes, const Mesh& mesh,
                const std::vector<slice::Plane>& planes) {
  const slice::Cutter cutter(mesh, planes);
  const auto& [layers, nozzle] = handed[scopes.front().of_mix.front()];
  return tasks::parallel_map(cutter.size(),
                             [&cutter, &layers = layers](std::size_t i) { return cutter.cut(i, layers); });
}

}  // namespace

Result<Cuts> slice_object(const Running& job, const Object& object, const ObjectScopes& scopes,
                          const Scopes& all_scopes, const SliceHands& handed, std::vector<Areas>& areas) {
  const Um top = top_of(object);
  const auto planes = layers_of(object, scopes, handed, top);
  if (!object.heights.empty() && !follows_profile(object, top))
    job.report.warnings.push_back(
        {"layer_heights_left_out",
         fmt::format(
             "object '{}': the heights of layers that came with it are for {:g} mm, and it is {:g} mm high: its "
             "layers are as the settings say",
             object.name, to_mm(object.heights.back().z), to_mm(top))});
  std::vector<Result<Cuts>> of_volume;
  for (const auto& volume : object.volumes)
    of_volume.push_back(volume.kind == VolumeKind::tint
                            ? Result<Cuts>(Cuts{})
                            : run_stage<Stage::slice>(
                                  job, [&] { return slice_key(volume.mesh, planes, scopes, handed); },
                                  [&] { return slice_mesh(handed, scopes, volume.mesh, planes); }));
  const auto& [layers, nozzle] = handed[scopes.front().of_mix.front()];
  const auto bridging = layers.counterbore_hole_bridging;
  if (of_volume.size() == 1) {
    areas = areas_of_one(scopes, *of_volume.front());
    if (bridging == CounterboreHoleBridging::none) return std::move(of_volume.front());
    Cuts out = *of_volume.front();
    bridge_counterbores(bridging, nozzle, object, out, areas, job.report.warnings);
    return Result<Cuts>(std::move(out));
  }
  const Stopwatch stopwatch(job.report.timings_ms[Stage::slice]);
  std::vector<const Cuts*> cuts;
  for (const auto& result : of_volume) cuts.push_back(&*result);
  std::vector<Cuts> painted;
  if (is_painted(object)) {
    painted = paint_cuts(object, reach_of(all_scopes, scopes), cuts);
    for (std::size_t v = 0; v < cuts.size(); ++v)
      if (object.volumes[v].kind == VolumeKind::tint) cuts[v] = &painted[v];
  }
  auto out = united(object, scopes, cuts, areas);
  if (const auto how = weave_of(scopes, all_scopes)) weave(*how, out, areas);
  if (bridging != CounterboreHoleBridging::none)
    bridge_counterbores(bridging, nozzle, object, out, areas, job.report.warnings);
  return Result<Cuts>(std::move(out));
}

std::vector<std::string> slice_hashes(const Object& object, const ObjectScopes& scopes, const Scopes& all_scopes,
                                      const SliceHands& handed) {
  const auto how = weave_of(scopes, all_scopes);
  const auto planes = layers_of(object, scopes, handed, top_of(object));
  std::vector<std::string> out;
  for (const auto& volume : object.volumes) {
    auto key = slice_key(volume.mesh, planes, scopes, handed);
    if (volume.kind != VolumeKind::model) key.with(std::uint64_t{static_cast<std::uint8_t>(volume.kind)});
    if (volume.kind == VolumeKind::tint) {
      const auto reach = reach_of(all_scopes, scopes);
      key.with(reach.depth).with(reach.roof).with(reach.floor).with(reach.least);
    }
    if (how)
      for (const auto& from : scopes)
        for (const ScopeId id : from.of_mix) key.with(Um{how->tool.at(id)});
    out.push_back(key.hash());
  }
  return out;
}

}  // namespace weft::pipeline
