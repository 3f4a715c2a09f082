// SPDX-License-Identifier: GPL-3.0-or-later
// What each stage costs a unit of its work, on one core, with the settings of the profiles given:
//   benchmark_stages MODEL [PROFILE.ini]... [--benchmark_filter=walls]
// `each` is what one costs of what the stage's cost grows with: triangles, vertices of outlines, beads, junctions,
// bytes. Travel and motion are measured with a copy of their input, which is small beside them.
#include "audit/audit.h"
#include "gcode/writer.h"
#include "geometry/medial_axis.h"
#include "infill/infill.h"
#include "infill/shells.h"
#include "mesh/read.h"
#include "motion/motion.h"
#include "profile/profile.h"
#include "slice/slice.h"
#include "travel/tour.h"
#include "travel/travel.h"
#include "walls/walls.h"

#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

namespace {
using namespace weft;

std::int64_t vertices_of(const std::vector<SlicedLayer>& layers) {
  std::size_t count = 0;
  for (const auto& layer : layers)
    for (const auto& region : layer.regions) {
      count += region.outer.size();
      for (const auto& hole : region.holes) count += hole.size();
    }
  return static_cast<std::int64_t>(count);
}

/// One job, stage by stage: each stage's input is what the one before it made.
struct Bench {
  std::string bytes, path;
  Settings settings;
  Mesh mesh;
  std::vector<slice::Plane> planes;
  std::vector<SlicedLayer> layers;
  std::vector<WallLayer> walls;
  std::vector<infill::ShellLayer> seen;
  std::vector<infill::LayerAreas> areas;
  std::vector<travel::LayerInput> inputs;
  PrintPlan routed;
  motion::Planned planned;
  std::string text;

  void prepare() {
    mesh = mesh::read(bytes, path).objects.front().mesh;
    Box3 box = box_of(mesh);
    for (auto& v : mesh.vertices) v.z -= box.min.z;
    planes = slice::planes(settings.layers, box_of(mesh).max.z);
    layers = slice_layers();
    walls = build_walls();
    for (std::size_t i = 0; i < layers.size(); ++i)
      seen.push_back({layers[i].z, layers[i].height, &layers[i].regions, &walls[i].inside});
    areas = find_areas();
    for (std::size_t i = 0; i < layers.size(); ++i) {
      travel::LayerInput input{
          .time = {.index = static_cast<std::uint32_t>(i), .number = static_cast<std::uint32_t>(i)},
          .z = layers[i].z,
          .height = layers[i].height,
          .adhesion = {},
          .objects = {},
          .room = {}};
      auto beads = walls[i].beads;
      for (auto& bead : fill_layer(i)) beads.push_back(std::move(bead));
      input.objects.push_back(
          {.beads = std::move(beads), .outline = layers[i].regions, .skin = {}, .top = {}, .sparse = {}});
      inputs.push_back(std::move(input));
    }
    routed.layers = travel();
    routed.objects = {{"object", {}, {}}};
    planned = motion();
    text = gcode();
  }
  std::vector<SlicedLayer> slice_layers() const {
    const slice::Cutter cutter(mesh, planes);
    std::vector<SlicedLayer> out;
    for (std::size_t i = 0; i < cutter.size(); ++i) out.push_back(cutter.cut(i, settings.layers).layer);
    return out;
  }
  std::vector<WallLayer> build_walls() const {
    std::vector<WallLayer> out;
    for (std::size_t i = 0; i < layers.size(); ++i)
      out.push_back(walls::build(
          settings.walls, {.layer = layers[i], .index = i, .nozzle_diameter = settings.machine.nozzle_diameter}));
    return out;
  }
  std::vector<infill::LayerAreas> find_areas() const {
    const infill::ShellObject object{seen, infill::box_of(seen), settings.machine.nozzle_diameter};
    return infill::find_areas(settings.shells, settings.infill, object, 0, seen.size());
  }
  Beads fill_layer(std::size_t i) const {
    return infill::fill(settings.infill, settings.shells,
                        {.areas = areas[i],
                         .index = i,
                         .z = layers[i].z,
                         .height = layers[i].height,
                         .nozzle = settings.machine.nozzle_diameter})
        .beads;
  }
  std::size_t fill() const {
    std::size_t beads = 0;
    for (std::size_t i = 0; i < layers.size(); ++i) beads += fill_layer(i).size();
    return beads;
  }
  std::vector<LayerPlan> travel() const { return travel::plan(settings.travel, settings.retraction, inputs); }
  motion::Planned motion() const { return motion::plan(motion::rules_of(settings), routed); }
  std::string gcode() const { return gcode::write({settings, planned.plan, planned.statistics, "object", {}}); }
  std::int64_t audit() const {
    return audit::examine_text(settings.machine, settings.material, settings.audit, text).checked_moves;
  }

  std::int64_t beads() const {
    std::size_t count = 0;
    for (const auto& input : inputs) count += input.objects.front().beads.size();
    return static_cast<std::int64_t>(count);
  }
  std::int64_t junctions() const {
    std::size_t count = 0;
    for (const auto& input : inputs)
      for (const auto& bead : input.objects.front().beads) count += bead.path.size();
    return static_cast<std::int64_t>(count);
  }
};

/// Short paths at random on a layer of 200 × 200 mm.
std::vector<travel::Stop> short_paths(std::size_t count) {
  std::mt19937 random(1);
  std::vector<travel::Stop> stops(count);
  for (auto& stop : stops) {
    const auto at = [&](Um reach) { return static_cast<Um>(random() % static_cast<unsigned>(reach)); };
    stop.a = {at(200'000), at(200'000)};
    stop.b = {stop.a.x + at(2'000), stop.a.y + at(2'000)};
  }
  return stops;
}

template <class Work>
void add(const char* name, std::int64_t items, Work work) {
  benchmark::RegisterBenchmark(name, [=](benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(work());
    state.counters["each"] = benchmark::Counter(static_cast<double>(state.iterations() * items),
                                                benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  })->Unit(benchmark::kMillisecond);
}

}  // namespace

int main(int count, char** arguments) {
  benchmark::Initialize(&count, arguments);
  if (count < 2) return fmt::print(stderr, "usage: benchmark_stages MODEL [PROFILE.ini]...\n"), 2;
  static Bench bench;
  bench.path = arguments[1];
  std::ifstream file(bench.path, std::ios::binary);
  bench.bytes.assign(std::istreambuf_iterator<char>(file), {});
  try {
    Profile profile;
    for (int i = 2; i < count; ++i) apply_file(profile, arguments[i]);
    bench.settings = profile.settings;
    bench.prepare();
  } catch (const std::exception& error) {
    return fmt::print(stderr, "{}\n", error.what()), 1;
  }
  const auto triangles = static_cast<std::int64_t>(bench.mesh.triangles.size());
  const auto vertices = vertices_of(bench.layers);
  add("read/triangle", triangles,
      [] { return mesh::read(bench.bytes, bench.path).objects.front().mesh.triangles.size(); });
  add("slice/triangle", triangles, [] { return bench.slice_layers().size(); });
  add("medial_axis/vertex", vertices, [] {
    std::size_t nodes = 0;
    for (const auto& layer : bench.layers)
      for (const auto& region : layer.regions) nodes += geometry::medial_axis(region).nodes.size();
    return nodes;
  });
  add("walls/vertex", vertices, [] { return bench.build_walls().size(); });
  add("shells/vertex", vertices, [] { return bench.find_areas().size(); });
  add("fill/bead", static_cast<std::int64_t>(bench.fill()), [] { return bench.fill(); });
  const auto bytes = static_cast<std::int64_t>(bench.text.size());
  add("travel/bead", bench.beads(), [] { return bench.travel().size(); });
  add("motion/junction", bench.junctions(), [] { return bench.motion().plan.layers.size(); });
  add("gcode/byte", bytes, [] { return bench.gcode().size(); });
  add("audit/byte", bytes, [] { return bench.audit(); });
  static const auto stops = short_paths(20'000);
  add("order/path", static_cast<std::int64_t>(stops.size()),
      [] { return travel::tour(PathOrder::optimized, stops, {}).size(); });
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
