// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/object_scopes.h"

#include "core/error.h"
#include "geometry/boolean.h"
#include "infill/density.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

void check_heights(const Object& object, const ObjectScopes& runs, const Scopes& scopes) {
  for (const auto& run : runs)
    for (const ScopeId id : run.of_volume) {
      const Um height = scopes[id].layers.layer_height, nozzle = scopes[id].machine.nozzle_diameter;
      if (height > nozzle)
        throw Error{Error::Kind::settings,
                    fmt::format("object '{}': layer_height {} mm is more than nozzle_diameter {} mm", object.name,
                                to_mm(height), to_mm(nozzle)),
                    {},
                    "a bead cannot be higher than the nozzle is wide"};
    }
}

/// What the closed and bridged gaps of two cuts of a layer are together.
slice::Gaps both(const slice::Gaps& a, const slice::Gaps& b) {
  auto out = b.widest_um > a.widest_um ? b : a;
  out.count = a.count + b.count;
  return out;
}

}  // namespace

ObjectScopes scopes_of(const Object& object, ToolScopes& tools, Scopes& scopes) {
  const auto lowest = [&](ScopeId id) {
    const bool raft = scopes[id].adhesion.adhesion_type == AdhesionType::raft;
    return raft ? scopes.on_raft(id) : scopes.on_first_layer(id);
  };
  ObjectScopes out;
  for (const Um bottom : heights_of_change(object)) {
    ScopesFrom run{bottom, {}}, first{0, {}};
    for (const auto& volume : object.volumes) {
      const auto overlays = overlays_at(object, volume, bottom);
      run.of_volume.push_back(tools.area(object, overlays, scopes));
      if (bottom == 0) first.of_volume.push_back(tools.lowest(run.of_volume.back(), lowest));
    }
    if (bottom == 0) {  // whatever lies a micron higher is no first layer
      out.push_back(std::move(first));
      run.bottom = 1;
    }
    out.push_back(std::move(run));
  }
  check_heights(object, out, scopes);
  return out;
}

const ScopesFrom& at(const ObjectScopes& scopes, Um bottom) {
  const auto above =
      std::upper_bound(scopes.begin(), scopes.end(), bottom, [](Um b, const ScopesFrom& s) { return b < s.bottom; });
  return above == scopes.begin() ? scopes.front() : *std::prev(above);
}

std::vector<Areas> areas_of_one(const ObjectScopes& scopes, const std::vector<slice::Cut>& cuts) {
  std::vector<Areas> out;
  out.reserve(cuts.size());
  for (const auto& cut : cuts)
    out.push_back({{at(scopes, cut.layer.z - cut.layer.height).of_volume.front(),
                    static_cast<std::uint32_t>(cut.layer.regions.size())}});
  return out;
}

std::vector<slice::Cut> united(const ObjectScopes& scopes, const std::vector<const std::vector<slice::Cut>*>& cuts,
                               std::vector<Areas>& areas) {
  std::size_t count = 0;
  for (const auto* of_volume : cuts) count = std::max(count, of_volume->size());
  struct Layer {
    slice::Cut cut;
    Areas areas;
  };
  auto layers = tasks::parallel_map(count, [&](std::size_t i) {
    Layer out;
    std::vector<std::pair<ScopeId, Regions>> parts;  // by scope, in the order of volumes
    for (std::size_t v = 0; v < cuts.size(); ++v) {
      if (i >= cuts[v]->size()) continue;
      const auto& cut = (*cuts[v])[i];
      out.cut.layer.z = cut.layer.z, out.cut.layer.height = cut.layer.height;
      out.cut.closed = both(out.cut.closed, cut.closed), out.cut.bridged = both(out.cut.bridged, cut.bridged);
      const ScopeId scope = at(scopes, cut.layer.z - cut.layer.height).of_volume[v];
      for (auto& [other, regions] : parts)
        if (other != scope) regions = geometry::subtract(regions, cut.layer.regions);
      const auto same = std::find_if(parts.begin(), parts.end(), [&](const auto& part) { return part.first == scope; });
      if (same == parts.end())
        parts.emplace_back(scope, cut.layer.regions);
      else
        same->second = geometry::unite(same->second, cut.layer.regions);
    }
    for (auto& [scope, regions] : parts) {
      out.areas.push_back({scope, static_cast<std::uint32_t>(regions.size())});
      std::move(regions.begin(), regions.end(), std::back_inserter(out.cut.layer.regions));
    }
    return out;
  });
  std::vector<slice::Cut> out;
  for (auto& layer : layers) {
    out.push_back(std::move(layer.cut));
    areas.push_back(std::move(layer.areas));
  }
  return out;
}

std::string files_of_infill(const Scopes& scopes, Point at) {
  std::string out;
  for (ScopeId id = 0; id < scopes.size(); ++id) {
    out += infill::Density::files_of(scopes[id].infill);
    if (scopes[id].infill.infill_phase_frame == InfillFrame::plate) out += "plate";
  }
  return out.empty() ? out : fmt::format("{} {} {}", out, at.x, at.y);
}

}  // namespace weft::pipeline
