#include "pipeline/parallel.h"
#include "pipeline/stages.h"
#include "pipeline/stopwatch.h"

#include "core/error.h"
#include "geometry/boolean.h"
#include "infill/infill.h"
#include "infill/shells.h"
#include "slice/slice.h"
#include "walls/walls.h"

#include <algorithm>
#include <iterator>

namespace weft::pipeline {
namespace {

void append(Notices& to, Notices from) { std::move(from.begin(), from.end(), std::back_inserter(to)); }

std::vector<SlicedLayer> slice_object(const Settings& settings, const PlacedObject& object, const Watch& watch, Report& report) {
  const Stopwatch stopwatch(report.timings_ms.slice);
  const slice::Cutter cutter(object.mesh, slice::planes(settings.layers, box_of(object.mesh).max.z));
  auto cuts = parallel_map(cutter.size(), [&](std::size_t i) {
    stop_if_cancelled(watch);
    return cutter.cut(i, settings.layers.resolution);
  });
  append(report.warnings, slice::notices_of(cuts, object.name));
  std::vector<SlicedLayer> layers;
  layers.reserve(cuts.size());
  for (auto& cut : cuts) layers.push_back(std::move(cut.layer));
  return layers;
}

/// The settings of the first layer, whose lines may have a width of their own.
Settings of_first_layer(Settings settings) {
  if (const auto width = settings.layers.initial_layer_line_width) {
    settings.walls.wall_line_width_0 = settings.walls.wall_line_width_x = width;
    settings.infill.infill_line_width = settings.shells.skin_line_width = settings.shells.top_skin_line_width = width;
  }
  return settings;
}

std::vector<WallLayer> build_walls(const Settings& settings, const Settings& first, const std::vector<SlicedLayer>& layers, const Watch& watch, Report& report) {
  const Stopwatch stopwatch(report.timings_ms.walls);
  auto walls = parallel_map(layers.size(), [&](std::size_t i) {
    stop_if_cancelled(watch);
    const Regions over_air = i > 0 ? geometry::subtract(layers[i].regions, layers[i - 1].regions) : Regions{};
    return walls::build((i == 0 ? first : settings).walls,
                        {.layer = layers[i], .index = i, .nozzle_diameter = settings.machine.nozzle_diameter, .over_air = &over_air});
  });
  for (auto& layer : walls) append(report.warnings, std::move(layer.notices));
  return walls;
}

/// What fills the inside of each layer. Layers are taken in runs, so that the skin's neighbours are looked at once a run.
std::vector<infill::LayerAreas> find_areas(const Settings& settings, const std::vector<SlicedLayer>& layers, const std::vector<WallLayer>& walls) {
  std::vector<infill::ShellLayer> seen(layers.size());
  for (std::size_t i = 0; i < layers.size(); ++i) seen[i] = {layers[i].z, layers[i].height, &layers[i].regions, &walls[i].inside};
  const infill::ShellObject object{seen, infill::box_of(seen), settings.machine.nozzle_diameter};
  constexpr std::size_t run = 16;
  auto runs = parallel_map((layers.size() + run - 1) / run, [&](std::size_t r) {
    return infill::find_areas(settings.shells, settings.infill, object, r * run, std::min(run, layers.size() - r * run));
  });
  std::vector<infill::LayerAreas> areas;
  areas.reserve(layers.size());
  for (auto& part : runs) std::move(part.begin(), part.end(), std::back_inserter(areas));
  return areas;
}

}  // namespace

PrintedLayers print_object(const Settings& settings, const PlacedObject& object, const Watch& watch, Report& report) {
  auto layers = slice_object(settings, object, watch, report);
  watch.progress("walls", 0.15);
  const auto first = of_first_layer(settings);
  auto walls = build_walls(settings, first, layers, watch, report);
  watch.progress("infill", 0.5);

  const Stopwatch stopwatch(report.timings_ms.infill);
  const auto areas = find_areas(settings, layers, walls);
  Box box;  // patterns hang on its centre, so they move with the object
  for (const auto& layer : layers) box.add(box_of(layer.regions));
  auto fills = parallel_map(layers.size(), [&](std::size_t i) {
    stop_if_cancelled(watch);
    const auto& s = i == 0 ? first : settings;
    return infill::fill(s.infill, s.shells, {.areas = areas[i], .index = i, .z = layers[i].z, .height = layers[i].height,
                                                           .nozzle = settings.machine.nozzle_diameter,
                                                           .wall_line_width = s.walls.wall_line_width_x.value_or(0),
                                                           .origin = box.empty() ? Point{} : box.centre()});
  });
  PrintedLayers out(layers.size());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    out[i].z = layers[i].z;
    out[i].height = layers[i].height;
    out[i].outline = std::move(layers[i].regions);
    for (const auto& part : areas[i]) {
      out[i].top.insert(out[i].top.end(), part.top.begin(), part.top.end());
      out[i].sparse.insert(out[i].sparse.end(), part.sparse.begin(), part.sparse.end());
      out[i].skin.insert(out[i].skin.end(), part.top.begin(), part.top.end());
      out[i].skin.insert(out[i].skin.end(), part.solid.begin(), part.solid.end());
    }
    out[i].beads = std::move(walls[i].beads);
    std::move(fills[i].beads.begin(), fills[i].beads.end(), std::back_inserter(out[i].beads));
    append(report.warnings, std::move(fills[i].notices));
  }
  return out;
}

void stop_if_cancelled(const Watch& watch) {
  if (watch.cancelled()) throw Error{Error::Kind::interrupted, "interrupted", {}, "nothing was written"};
}

}  // namespace weft::pipeline
