// SPDX-License-Identifier: GPL-3.0-or-later
#include "geometry/boolean.h"
#include "infill/infill.h"
#include "infill/shells.h"
#include "pipeline/cached.h"
#include "pipeline/stages.h"
#include "pipeline/stopwatch.h"
#include "slice/slice.h"
#include "tasks/parallel.h"
#include "walls/walls.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

/// Of an object that stands there: places are told as they are on the bed.
void append(Notices& to, std::vector<PlacedNotice> from, Point offset) {
  for (auto& notice : from) {
    const Point at = notice.at + offset;
    to.push_back(
        {std::move(notice.code), fmt::format("{}, at {:.2f}, {:.2f}", notice.message, to_mm(at.x), to_mm(at.y))});
  }
}

// Versions of stages: a change of what a stage makes of the same input needs no new one, because keys hold the build of
// weft; a change of what its key holds does.
StageKey slice_key(const Settings& settings, const Mesh& mesh) {
  const auto bytes = [](const auto& items) {
    return std::string_view(reinterpret_cast<const char*>(items.data()), items.size() * sizeof(items[0]));
  };
  return StageKey("slice", 1)
      .with(sha256(bytes(mesh.vertices)))
      .with(sha256(bytes(mesh.triangles)))
      .with(settings.layers, layer_schema);
}
StageKey walls_key(const Settings& settings, const std::string& slice) {
  return StageKey("walls", 1).with(slice).with(settings.walls, wall_schema).with(settings.machine.nozzle_diameter);
}
StageKey fill_key(const Settings& settings, const std::string& walls) {
  return StageKey("infill", 1)
      .with(walls)
      .with(settings.shells, shell_schema)
      .with(settings.infill, infill_schema)
      .with(settings.machine.nozzle_diameter)
      .with(settings.walls.wall_line_width_x)
      .with(settings.walls.overlap_factor);
}

using Cuts = std::vector<slice::Cut>;
using Walls = std::vector<WallLayer>;
using Fills = std::vector<FilledLayer>;

Cuts slice_object(const Settings& settings, const PlacedObject& object) {
  const slice::Cutter cutter(object.mesh, slice::planes(settings.layers, box_of(object.mesh).max.z));
  return tasks::parallel_map(cutter.size(), [&](std::size_t i) { return cutter.cut(i, settings.layers); });
}

/// The settings of the first layer, whose lines may have a width of their own.
Settings of_first_layer(Settings settings) {
  if (const auto width = settings.layers.initial_layer_line_width) {
    settings.walls.wall_line_width_0 = settings.walls.wall_line_width_x = width;
    settings.infill.infill_line_width = settings.shells.skin_line_width = settings.shells.top_skin_line_width = width;
  }
  return settings;
}

Walls build_walls(const Settings& settings, const Settings& first, const Cuts& cuts) {
  return tasks::parallel_map(cuts.size(), [&](std::size_t i) {
    const Regions over_air = i > 0 ? geometry::subtract(cuts[i].layer.regions, cuts[i - 1].layer.regions) : Regions{};
    return walls::build((i == 0 ? first : settings).walls,
                        {.layer = cuts[i].layer,
                         .index = i,
                         .nozzle_diameter = settings.machine.nozzle_diameter,
                         .over_air = &over_air,
                         .above = i + 1 < cuts.size() ? &cuts[i + 1].layer.regions : nullptr});
  });
}

/// What fills the inside of each layer. Layers are taken in runs, so that the skin's neighbours are looked at once a
/// run.
std::vector<infill::LayerAreas> find_areas(const Settings& settings, const Cuts& cuts, const Walls& walls) {
  std::vector<infill::ShellLayer> seen(cuts.size());
  for (std::size_t i = 0; i < cuts.size(); ++i)
    seen[i] = {cuts[i].layer.z, cuts[i].layer.height, &cuts[i].layer.regions, &walls[i].inside};
  const infill::ShellObject object{seen, infill::box_of(seen), settings.machine.nozzle_diameter};
  constexpr std::size_t run = 8;
  auto runs = tasks::parallel_map((cuts.size() + run - 1) / run, [&](std::size_t r) {
    return infill::find_areas(settings.shells, settings.infill, object, r * run, std::min(run, cuts.size() - r * run));
  });
  std::vector<infill::LayerAreas> areas;
  areas.reserve(cuts.size());
  for (auto& part : runs) std::move(part.begin(), part.end(), std::back_inserter(areas));
  infill::keep_below_tops(settings.infill, object, areas);
  infill::combine_sparse(settings.infill, object, areas);
  return areas;
}

/// Shells and infill.
Fills fill_object(const Settings& settings, const Settings& first, const Cuts& cuts, const Walls& walls) {
  auto areas = find_areas(settings, cuts, walls);
  Box box;  // patterns hang on its centre, so they move with the object
  for (const auto& cut : cuts) box.add(box_of(cut.layer.regions));
  // Layers are let go of as they are filled: what the next one must know of their bridges is set aside.
  std::vector<std::vector<infill::BridgeArea>> bridges(cuts.size());
  for (std::size_t i = 0; i < cuts.size(); ++i)
    for (const auto& part : areas[i]) bridges[i].insert(bridges[i].end(), part.bridges.begin(), part.bridges.end());
  return tasks::parallel_map(cuts.size(), [&](std::size_t i) {
    const auto& layer = cuts[i].layer;
    const auto& s = i == 0 ? first : settings;
    auto filled = infill::fill(s.infill, s.shells,
                               {.areas = areas[i],
                                .index = i,
                                .z = layer.z,
                                .height = layer.height,
                                .nozzle = settings.machine.nozzle_diameter,
                                .overlap_factor = s.walls.overlap_factor,
                                .wall_line_width = s.walls.wall_line_width_x.value_or(0),
                                .origin = box.empty() ? Point{} : box.centre(),
                                .bridges_below = i > 0 ? std::span<const infill::BridgeArea>(bridges[i - 1])
                                                       : std::span<const infill::BridgeArea>{}});
    FilledLayer out{{}, {}, {}, std::move(filled.beads), std::move(filled.notices)};
    for (auto& part : std::exchange(areas[i], {})) {
      out.skin.insert(out.skin.end(), part.top.begin(), part.top.end());
      std::move(part.solid.begin(), part.solid.end(), std::back_inserter(out.skin));
      std::move(part.top.begin(), part.top.end(), std::back_inserter(out.top));
      std::move(part.sparse.begin(), part.sparse.end(), std::back_inserter(out.sparse));
      std::move(part.combined.begin(), part.combined.end(), std::back_inserter(out.sparse));
    }
    return out;
  });
}

}  // namespace

PrintedLayers print_object(const Settings& settings, const PlacedObject& object, const Watch& watch, Report& report,
                           StageCache* cache) {
  std::optional<Stopwatch> stopwatch(std::in_place, report.timings_ms.slice);
  const auto sliced_by = [&] { return slice_key(settings, object.mesh); };
  auto sliced = cached(cache, sliced_by, [&] { return slice_object(settings, object); });
  append(report.warnings, slice::notices_of(*sliced, object.name), object.offsets.front());

  watch.progress("walls", 0.15);
  stopwatch.emplace(report.timings_ms.walls);
  const auto walls_by = [&] { return walls_key(settings, sliced_by().hash()); };
  const auto first =
      of_first_layer(settings);  // a function of what the keys hold: all of layers, walls, shells and infill
  auto walled = cached(cache, walls_by, [&] { return build_walls(settings, first, *sliced); });

  watch.progress("infill", 0.5);
  stopwatch.emplace(report.timings_ms.infill);
  auto filled = cached(
      cache, [&] { return fill_key(settings, walls_by().hash()); },
      [&] { return fill_object(settings, first, *sliced, *walled); });

  auto cuts = std::move(sliced).take();
  auto walls = std::move(walled).take();
  auto fills = std::move(filled).take();
  PrintedLayers out(cuts.size());
  for (auto& layer : walls) append(report.warnings, std::move(layer.notices), object.offsets.front());
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
    std::move(fill.notices.begin(), fill.notices.end(), std::back_inserter(report.warnings));
  }
  return out;
}

}  // namespace weft::pipeline
