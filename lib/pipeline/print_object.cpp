#include "geometry/boolean.h"
#include "infill/infill.h"
#include "infill/shells.h"
#include "pipeline/cached.h"
#include "pipeline/object_scopes.h"
#include "pipeline/stages.h"
#include "pipeline/stopwatch.h"
#include "slice/slice.h"
#include "tasks/parallel.h"
#include "walls/walls.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

namespace weft::pipeline {
namespace {

void append(Notices& to, Notices from) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
}

// Versions of stages: a change of what a stage makes of the same input needs no new one, because keys hold the build of
// weft; a change of what its key holds does. What stages read of the settings, and so what their keys hold:
constexpr Take slice_reads{WholeGroup{&Settings::layers, layer_schema}};
constexpr Take walls_read{WholeGroup{&Settings::walls, wall_schema},
                          OneValue{&Settings::machine, &MachineSettings::nozzle_diameter}};
constexpr Take fill_reads{WholeGroup{&Settings::shells, shell_schema}, WholeGroup{&Settings::infill, infill_schema},
                          OneValue{&Settings::machine, &MachineSettings::nozzle_diameter},
                          OneValue{&Settings::walls, &WallSettings::wall_line_width_x}};

using SliceHands = Handed<std::remove_const_t<decltype(slice_reads)>>;
using WallHands = Handed<std::remove_const_t<decltype(walls_read)>>;
using FillHands = Handed<std::remove_const_t<decltype(fill_reads)>>;

using Cuts = std::vector<slice::Cut>;
using Walls = std::vector<WallLayer>;
using Fills = std::vector<FilledLayer>;

/// Adds to a key what a stage is handed for each height and volume, and which volumes share their areas.
template <class T>
void add_handed(StageKey& key, const ObjectScopes& scopes, const Handed<T>& handed) {
  key.with(std::uint64_t{scopes.size()});
  for (const auto& from : scopes) {
    key.with(from.bottom).with(std::uint64_t{from.of_volume.size()});
    for (const ScopeId id : from.of_volume) {
      std::uint64_t first = 0;
      while (from.of_volume[first] != id) ++first;
      key.with(first).with(handed.bytes_of(id));
    }
  }
}

StageKey slice_key(const Mesh& mesh, const ObjectScopes& scopes, const SliceHands& handed) {
  const auto bytes = [](const auto& items) {
    return std::string_view(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(items[0]));
  };
  StageKey key("slice", 2);
  key.with(sha256(bytes(mesh.vertices))).with(sha256(bytes(mesh.triangles)));
  add_handed(key, scopes, handed);
  return key;
}
StageKey walls_key(const std::vector<std::string>& slices, const ObjectScopes& scopes, const WallHands& handed) {
  StageKey key("walls", 2);
  key.with(slices);
  add_handed(key, scopes, handed);
  return key;
}
StageKey fill_key(const std::string& walls, const ObjectScopes& scopes, const FillHands& handed) {
  StageKey key("infill", 2);
  key.with(walls);
  add_handed(key, scopes, handed);
  return key;
}

Cuts slice_mesh(const SliceHands& handed, const ObjectScopes& scopes, const Mesh& mesh) {
  std::vector<slice::HeightFrom> heights;
  for (const auto& from : scopes) {
    const auto& [layers] = handed[from.of_volume.front()];
    heights.push_back({from.bottom, layers.layer_height});
  }
  const slice::Cutter cutter(mesh, slice::planes(heights, box_of(mesh).max.z));
  const auto& [layers] = handed[scopes.front().of_volume.front()];
  const Um resolution = layers.resolution;
  return tasks::parallel_map(cutter.size(), [&](std::size_t i) { return cutter.cut(i, resolution); });
}

/// The scopes of a layer that a stage can tell apart, each with the regions that it holds for.
struct Told {
  ScopeId scope = 0;
  std::vector<std::uint32_t> regions;
};
template <class T>
std::vector<Told> told_apart(const Handed<T>& handed, const Areas& areas) {
  std::vector<Told> out;
  std::uint32_t region = 0;
  for (const auto& area : areas) {
    auto same = std::find_if(out.begin(), out.end(),
                             [&](const Told& told) { return handed.alike(told.scope) == handed.alike(area.scope); });
    if (same == out.end()) same = out.insert(out.end(), Told{area.scope, {}});
    for (std::uint32_t i = 0; i < area.regions; ++i) same->regions.push_back(region++);
  }
  return out;
}

/// The walls of a layer of several areas: those of each are built as if the others were not there.
template <class Build>
WallLayer walls_of_areas(const std::vector<Told>& told, const SlicedLayer& layer, const Build& build) {
  WallLayer out;
  for (const auto& [scope, regions] : told) {
    SlicedLayer own{layer.z, layer.height, {}};
    for (const std::uint32_t r : regions) own.regions.push_back(layer.regions[r]);
    auto walls = build(scope, own);
    for (auto& bead : walls.beads) bead.part = regions[std::min<std::size_t>(bead.part, regions.size() - 1)];
    std::move(walls.beads.begin(), walls.beads.end(), std::back_inserter(out.beads));
    std::move(walls.inside.begin(), walls.inside.end(), std::back_inserter(out.inside));
    append(out.notices, std::move(walls.notices));
  }
  return out;
}

Walls build_walls(const WallHands& handed, const Cuts& cuts, const std::vector<Areas>& areas) {
  return tasks::parallel_map(cuts.size(), [&](std::size_t i) {
    const Regions over_air = i > 0 ? geometry::subtract(cuts[i].layer.regions, cuts[i - 1].layer.regions) : Regions{};
    const auto build = [&](ScopeId scope, const SlicedLayer& layer) {
      const auto& [walls, nozzle] = handed[scope];
      return walls::build(walls, {.layer = layer, .index = i, .nozzle_diameter = nozzle, .over_air = &over_air});
    };
    if (areas[i].size() == 1) return build(areas[i].front().scope, cuts[i].layer);
    return walls_of_areas(told_apart(handed, areas[i]), cuts[i].layer, build);
  });
}

/// An object as shells look at it, and which scope each of its parts is asked for there: what is skin hangs on layers
/// above and below, so lines that are wider on the first layer alone count for nothing.
struct Shelled {
  const FillHands& handed;
  const Scopes& scopes;
  const std::vector<Areas>& areas;
  std::vector<infill::ShellLayer> layers;
  Box box;

  ScopeId scope_of(ScopeId id) const { return handed.alike(scopes.above_first_layer(id)); }
};

/// What fills the inside of layers [first, first + count).
std::vector<infill::LayerAreas> find_areas(const Shelled& object, std::size_t first, std::size_t count) {
  std::vector<ScopeId> asked;
  for (std::size_t i = first; i < first + count; ++i)
    for (const auto& area : object.areas[i])
      if (const ScopeId id = object.scope_of(area.scope); std::find(asked.begin(), asked.end(), id) == asked.end())
        asked.push_back(id);
  std::vector<infill::LayerAreas> out(count);
  for (const ScopeId id : asked) {
    const auto& [shells, infill, nozzle, width] = object.handed[id];
    auto found = infill::find_areas(shells, infill, {object.layers, object.box, nozzle}, first, count);
    if (asked.size() == 1) return found;
    for (std::size_t i = 0; i < count; ++i) {
      std::vector<char> own;  // by part
      for (const auto& area : object.areas[first + i])
        own.resize(own.size() + area.regions, object.scope_of(area.scope) == id);
      for (auto& part : found[i])
        if (part.part < own.size() && own[part.part] != 0) out[i].push_back(std::move(part));
    }
  }
  for (auto& layer : out)
    std::sort(layer.begin(), layer.end(), [](const auto& a, const auto& b) { return a.part < b.part; });
  return out;
}

/// Layers are taken in runs, so that the skin's neighbours are looked at once a run.
std::vector<infill::LayerAreas> find_all_areas(const Shelled& object) {
  constexpr std::size_t run = 8;
  const std::size_t count = object.layers.size();
  auto runs = tasks::parallel_map((count + run - 1) / run, [&](std::size_t r) {
    return find_areas(object, r * run, std::min(run, count - r * run));
  });
  std::vector<infill::LayerAreas> areas;
  areas.reserve(count);
  for (auto& part : runs) std::move(part.begin(), part.end(), std::back_inserter(areas));
  return areas;
}

/// The parts of a layer that lie in these regions.
infill::LayerAreas parts_in(const infill::LayerAreas& parts, const std::vector<std::uint32_t>& regions) {
  infill::LayerAreas out;
  std::copy_if(parts.begin(), parts.end(), std::back_inserter(out),
               [&](const auto& part) { return std::binary_search(regions.begin(), regions.end(), part.part); });
  return out;
}

/// Of a layer of several areas. Sequences of one are not continued by the next.
template <class Fill>
FillLayer fill_of_areas(const std::vector<Told>& told, const infill::LayerAreas& parts, const Fill& fill) {
  FillLayer out;
  std::uint32_t sequences = 0;
  for (const auto& [scope, regions] : told) {
    auto filled = fill(scope, parts_in(parts, regions));
    std::uint32_t most = sequences;
    for (auto& bead : filled.beads) {
      if (bead.sequence != 0) bead.sequence += sequences;
      most = std::max(most, bead.sequence);
    }
    sequences = most;
    std::move(filled.beads.begin(), filled.beads.end(), std::back_inserter(out.beads));
    append(out.notices, std::move(filled.notices));
  }
  return out;
}

/// Shells and infill.
Fills fill_object(const FillHands& handed, const Scopes& scopes, const Cuts& cuts, const std::vector<Areas>& areas,
                  const Walls& walls) {
  Shelled object{handed, scopes, areas, std::vector<infill::ShellLayer>(cuts.size()), {}};
  for (std::size_t i = 0; i < cuts.size(); ++i)
    object.layers[i] = {cuts[i].layer.z, cuts[i].layer.height, &cuts[i].layer.regions, &walls[i].inside};
  object.box = infill::box_of(object.layers);
  auto parts = find_all_areas(object);
  Box box;  // patterns hang on its centre, so they move with the object
  for (const auto& cut : cuts) box.add(box_of(cut.layer.regions));
  return tasks::parallel_map(cuts.size(), [&](std::size_t i) {
    const auto& layer = cuts[i].layer;
    const auto fill = [&](ScopeId scope, const infill::LayerAreas& own) {
      const auto& [shells, infill, nozzle, wall_line_width] = handed[scope];
      return infill::fill(infill, shells,
                          {.areas = own,
                           .index = i,
                           .z = layer.z,
                           .height = layer.height,
                           .nozzle = nozzle,
                           .wall_line_width = wall_line_width.value_or(0),
                           .origin = box.empty() ? Point{} : box.centre()});
    };
    auto filled = areas[i].size() == 1 ? fill(areas[i].front().scope, parts[i])
                                       : fill_of_areas(told_apart(handed, areas[i]), parts[i], fill);
    FilledLayer out{{}, {}, {}, std::move(filled.beads), std::move(filled.notices)};
    for (auto& part : std::exchange(parts[i], {})) {
      out.skin.insert(out.skin.end(), part.top.begin(), part.top.end());
      std::move(part.solid.begin(), part.solid.end(), std::back_inserter(out.skin));
      std::move(part.top.begin(), part.top.end(), std::back_inserter(out.top));
      std::move(part.sparse.begin(), part.sparse.end(), std::back_inserter(out.sparse));
    }
    return out;
  });
}

/// Each bead is told the scope of its part.
void tell_scopes(const Areas& areas, Beads& beads) {
  if (areas.size() == 1) {
    for (auto& bead : beads) bead.scope = areas.front().scope;
    return;
  }
  std::vector<ScopeId> of_part;
  for (const auto& area : areas) of_part.resize(of_part.size() + area.regions, area.scope);
  for (auto& bead : beads)
    if (bead.part < of_part.size()) bead.scope = of_part[bead.part];
}

PrintedLayers put_together(Cuts cuts, const std::vector<Areas>& areas, Walls walls, Fills fills, Notices& notices) {
  PrintedLayers out(cuts.size());
  for (auto& layer : walls) append(notices, std::move(layer.notices));
  for (std::size_t i = 0; i < out.size(); ++i) {
    auto& layer = cuts[i].layer;
    auto& fill = fills[i];
    out[i] = {layer.z,
              layer.height,
              std::move(layer.regions),
              std::move(fill.skin),
              std::move(fill.top),
              std::move(fill.sparse),
              std::move(walls[i].beads)};
    std::move(fill.beads.begin(), fill.beads.end(), std::back_inserter(out[i].beads));
    tell_scopes(areas[i], out[i].beads);
    append(notices, std::move(fill.notices));
  }
  return out;
}

/// The object's layers, each with its areas.
Result<Cuts> slice_object(const Object& object, const ObjectScopes& scopes, const SliceHands& handed, StageCache* cache,
                          std::vector<Areas>& areas) {
  std::vector<Result<Cuts>> of_volume;
  for (const auto& volume : object.volumes)
    of_volume.push_back(cached(
        cache, [&] { return slice_key(volume.mesh, scopes, handed); },
        [&] { return slice_mesh(handed, scopes, volume.mesh); }));
  if (of_volume.size() == 1) {
    areas = areas_of_one(scopes, *of_volume.front());
    return std::move(of_volume.front());
  }
  std::vector<const Cuts*> cuts;
  for (const auto& result : of_volume) cuts.push_back(&*result);
  auto all = united(scopes, cuts, areas);
  return Result<Cuts>(std::move(all));
}

}  // namespace

PrintedLayers print_object(const Scopes& all_scopes, const ObjectScopes& scopes, const Object& object,
                           const Watch& watch, Report& report, StageCache* cache) {
  std::optional<Stopwatch> stopwatch(std::in_place, report.timings_ms.slice);
  const SliceHands slice_hands(slice_reads, all_scopes);
  std::vector<Areas> areas;
  auto sliced = slice_object(object, scopes, slice_hands, cache, areas);
  append(report.warnings, slice::notices_of(*sliced, object.name));

  watch.progress("walls", 0.15);
  stopwatch.emplace(report.timings_ms.walls);
  const WallHands wall_hands(walls_read, all_scopes);
  const auto walls_by = [&] {
    std::vector<std::string> slices;
    for (const auto& volume : object.volumes) slices.push_back(slice_key(volume.mesh, scopes, slice_hands).hash());
    return walls_key(slices, scopes, wall_hands);
  };
  auto walled = cached(cache, walls_by, [&] { return build_walls(wall_hands, *sliced, areas); });

  watch.progress("infill", 0.5);
  stopwatch.emplace(report.timings_ms.infill);
  const FillHands fill_hands(fill_reads, all_scopes);
  auto filled = cached(
      cache, [&] { return fill_key(walls_by().hash(), scopes, fill_hands); },
      [&] { return fill_object(fill_hands, all_scopes, *sliced, areas, *walled); });
  return put_together(std::move(sliced).take(), areas, std::move(walled).take(), std::move(filled).take(),
                      report.warnings);
}

}  // namespace weft::pipeline
