#include "geometry/boolean.h"
#include "geometry/offset.h"
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

namespace weft::pipeline {
namespace {

void append(Notices& to, Notices from) {
  std::move(from.begin(), from.end(), std::back_inserter(to));
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
      .with(settings.walls.wall_line_width_x);
}

using Cuts = std::vector<slice::Cut>;
using Walls = std::vector<WallLayer>;
using Fills = std::vector<FilledLayer>;

Cuts slice_object(const Settings& settings, const PlacedObject& object) {
  const slice::Cutter cutter(object.mesh, slice::planes(settings.layers, box_of(object.mesh).max.z));
  return tasks::parallel_map(cutter.size(), [&](std::size_t i) { return cutter.cut(i, settings.layers.resolution); });
}

/// The settings of the first layer, whose lines may have a width of their own.
Settings of_first_layer(Settings settings) {
  if (const auto width = settings.layers.initial_layer_line_width) {
    settings.walls.wall_line_width_0 = settings.walls.wall_line_width_x = width;
    settings.infill.infill_line_width = settings.shells.skin_line_width = settings.shells.top_skin_line_width = width;
  }
  return settings;
}

/// About what walls leave of a layer: enough for the layers around it to know their skin.
WallLayer without_beads(const Settings& settings, const Regions& regions) {
  const Um width = settings.walls.wall_line_width_x.value_or(settings.machine.nozzle_diameter);
  WallLayer out;
  out.inside = geometry::offset(regions, {.by = -settings.walls.wall_line_count * width});
  return out;
}

Walls build_walls(const Settings& settings, const Settings& first, const Cuts& cuts, const Sample& sample) {
  return tasks::parallel_map(cuts.size(), [&](std::size_t i) {
    if (!sample.has(i)) return without_beads(settings, cuts[i].layer.regions);
    const Regions over_air = i > 0 ? geometry::subtract(cuts[i].layer.regions, cuts[i - 1].layer.regions) : Regions{};
    return walls::build((i == 0 ? first : settings).walls, {.layer = cuts[i].layer,
                                                            .index = i,
                                                            .nozzle_diameter = settings.machine.nozzle_diameter,
                                                            .over_air = &over_air});
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
  return areas;
}

double outline_mm(const Regions& regions) {
  double out = 0;
  for (const auto& region : regions) {
    out += perimeter_of(region.outer);
    for (const auto& hole : region.holes) out += perimeter_of(hole);
  }
  return out / 1000;
}

/// What the beads of each layer grow with. Of a layer with beads, too, the walls are measured as of one without.
std::vector<LayerMeasure> measures_of(const Settings& settings, const Cuts& cuts,
                                      const std::vector<infill::LayerAreas>& areas) {
  return tasks::parallel_map(cuts.size(), [&](std::size_t i) {
    const auto& layer = cuts[i].layer;
    LayerMeasure out{.outline_mm = outline_mm(layer.regions), .height_mm = to_mm(layer.height)};
    const auto inside = without_beads(settings, layer.regions).inside;
    out.walls_mm3 = (area_mm2(layer.regions) - area_mm2(inside)) * out.height_mm;
    for (const auto& part : areas[i]) {
      out.solid_mm2 += area_mm2(part.solid);
      out.top_mm2 += area_mm2(part.top);
      out.sparse_mm2 += area_mm2(part.sparse);
      for (const auto& bridge : part.bridges) out.bridge_mm2 += area_mm2(bridge.regions);
    }
    return out;
  });
}

/// Shells and infill.
/// @param measures of each layer, where only a sample gets beads
Fills fill_object(const Settings& settings, const Settings& first, const Cuts& cuts, const Walls& walls,
                  const Sample& sample, std::vector<LayerMeasure>& measures) {
  auto areas = find_areas(settings, cuts, walls);
  if (!sample.all()) measures = measures_of(settings, cuts, areas);
  Box box;  // patterns hang on its centre, so they move with the object
  for (const auto& cut : cuts) box.add(box_of(cut.layer.regions));
  return tasks::parallel_map(cuts.size(), [&](std::size_t i) {
    const auto& layer = cuts[i].layer;
    if (!sample.has(i)) return FilledLayer{};
    const auto& s = i == 0 ? first : settings;
    auto filled = infill::fill(s.infill, s.shells,
                               {.areas = areas[i],
                                .index = i,
                                .z = layer.z,
                                .height = layer.height,
                                .nozzle = settings.machine.nozzle_diameter,
                                .wall_line_width = s.walls.wall_line_width_x.value_or(0),
                                .origin = box.empty() ? Point{} : box.centre()});
    FilledLayer out{{}, {}, {}, std::move(filled.beads), std::move(filled.notices)};
    for (auto& part : std::exchange(areas[i], {})) {
      out.skin.insert(out.skin.end(), part.top.begin(), part.top.end());
      std::move(part.solid.begin(), part.solid.end(), std::back_inserter(out.skin));
      std::move(part.top.begin(), part.top.end(), std::back_inserter(out.top));
      std::move(part.sparse.begin(), part.sparse.end(), std::back_inserter(out.sparse));
    }
    return out;
  });
}

}  // namespace

PrintedLayers print_object(const Settings& settings, const PlacedObject& object, const Watch& watch, Report& report,
                           StageCache* cache, const Sample& sample, std::vector<LayerMeasure>* measures) {
  std::optional<Stopwatch> stopwatch(std::in_place, report.timings_ms.slice);
  const auto sliced_by = [&] { return slice_key(settings, object.mesh); };
  auto sliced = cached(cache, sliced_by, [&] { return slice_object(settings, object); });
  append(report.warnings, slice::notices_of(*sliced, object.name));

  watch.progress("walls", 0.15);
  stopwatch.emplace(report.timings_ms.walls);
  const auto walls_by = [&] { return walls_key(settings, sliced_by().hash()); };
  const auto first =
      of_first_layer(settings);        // a function of what the keys hold: all of layers, walls, shells and infill
  if (!sample.all()) cache = nullptr;  // a sample is no stage's result
  auto walled = cached(cache, walls_by, [&] { return build_walls(settings, first, *sliced, sample); });

  watch.progress("infill", 0.5);
  stopwatch.emplace(report.timings_ms.infill);
  std::vector<LayerMeasure> measured;
  auto filled = cached(
      cache, [&] { return fill_key(settings, walls_by().hash()); },
      [&] { return fill_object(settings, first, *sliced, *walled, sample, measured); });
  if (measures) *measures = std::move(measured);

  auto cuts = std::move(sliced).take();
  auto walls = std::move(walled).take();
  auto fills = std::move(filled).take();
  PrintedLayers out(cuts.size());
  for (auto& layer : walls) append(report.warnings, std::move(layer.notices));
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
    append(report.warnings, std::move(fill.notices));
  }
  return out;
}

}  // namespace weft::pipeline
