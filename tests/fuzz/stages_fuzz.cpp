// libFuzzer target for the stages between slices and G-code: random rings, a few layers of them, through walls, shells,
// infill, travel, motion, writer and audit at random settings. No stage throws; every G-code is read by the audit to its
// last line, and the same input gives the same bytes.
//   build/fuzz/tests/fuzz_stages -max_total_time=900 -max_len=512 corpus/
#include "audit/audit.h"
#include "gcode/writer.h"
#include "geometry/boolean.h"
#include "infill/infill.h"
#include "infill/shells.h"
#include "motion/motion.h"
#include "travel/travel.h"
#include "walls/walls.h"

#include <fuzzer/FuzzedDataProvider.h>

#include <cstdint>
#include <cstdlib>

namespace {

using namespace weft;

void require(bool holds) {
  if (!holds) std::abort();
}

Settings settings_from(FuzzedDataProvider& data) {
  Settings s;
  s.machine.home_position = Ring{{0, 0}};
  s.walls.wall_line_count = data.ConsumeIntegralInRange<int>(0, 6);
  if (data.ConsumeBool()) s.walls.wall_line_width_0 = data.ConsumeIntegralInRange<Um>(200, 1000);
  s.walls.flow_compensation = data.ConsumeBool();
  s.shells.top_layers = data.ConsumeIntegralInRange<int>(0, 3);
  s.shells.bottom_layers = data.ConsumeIntegralInRange<int>(0, 3);
  s.infill.infill_sparse_density = data.ConsumeIntegralInRange<int>(0, 100);
  s.infill.infill_pattern = static_cast<InfillPattern>(data.ConsumeIntegralInRange<int>(0, 4));
  s.retraction.retraction_hop = data.ConsumeBool() ? 400 : 0;
  s.retraction.wipe = data.ConsumeBool();
  return s;
}

/// Rings of any shape near the middle of the bed: points at random, some on a coarse grid so that they meet and line up. Within 10 mm, so that a run is short.
Regions regions_from(FuzzedDataProvider& data) {
  std::vector<Ring> rings(data.ConsumeIntegralInRange<std::size_t>(1, 4));
  for (auto& ring : rings) {
    const Um step = data.ConsumeBool() ? 1 : 250;
    const auto corners = data.ConsumeIntegralInRange<std::size_t>(3, 24);
    for (std::size_t i = 0; i < corners; ++i)
      ring.push_back({100'000 + step * (data.ConsumeIntegral<std::int16_t>() % (5'000 / step)),
                      100'000 + step * (data.ConsumeIntegral<std::int16_t>() % (5'000 / step))});
  }
  return geometry::regions_from_rings(rings, data.ConsumeBool() ? geometry::WindingRule::nonzero : geometry::WindingRule::even_odd);
}

std::string gcode_of(const Settings& s, const std::vector<SlicedLayer>& layers) {
  std::vector<WallLayer> walls;
  for (std::size_t i = 0; i < layers.size(); ++i)
    walls.push_back(walls::build(s.walls, {.layer = layers[i], .index = i, .nozzle_diameter = s.machine.nozzle_diameter}));
  std::vector<infill::ShellLayer> seen;
  for (std::size_t i = 0; i < layers.size(); ++i)
    seen.push_back({layers[i].z, layers[i].height, &layers[i].regions, &walls[i].inside});
  const infill::ShellObject object{seen, infill::box_of(seen), s.machine.nozzle_diameter};
  const auto areas = infill::find_areas(s.shells, s.infill, object, 0, seen.size());
  std::vector<travel::LayerInput> inputs(layers.size());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    auto fills = infill::fill(s.infill, s.shells,
                              {.areas = areas[i], .index = i, .z = layers[i].z, .height = layers[i].height,
                               .nozzle = s.machine.nozzle_diameter});
    travel::ObjectLayer one{.outline = layers[i].regions};
    one.beads = std::move(walls[i].beads);
    one.beads.insert(one.beads.end(), fills.beads.begin(), fills.beads.end());
    inputs[i].index = i, inputs[i].z = layers[i].z, inputs[i].height = layers[i].height;
    inputs[i].objects.push_back(std::move(one));
  }
  PrintPlan plan;
  plan.objects.push_back({"fuzz", {100'000, 100'000}, {}});
  plan.layers = travel::plan(s.travel, s.retraction, std::move(inputs));
  const auto rules = motion::rules_of(s);
  const auto starts = motion::starts_of(plan);
  Statistics statistics;
  for (std::size_t i = 0; i < plan.layers.size(); ++i) {
    auto planned = motion::plan_layer(rules, std::move(plan.layers[i]), i, starts[i]);
    plan.layers[i] = std::move(planned.plan);
    statistics.append(planned.statistics);
  }
  return gcode::write({s, plan, statistics, "fuzz", {}});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  FuzzedDataProvider data(bytes, size);
  const auto settings = settings_from(data);
  std::vector<SlicedLayer> layers(data.ConsumeIntegralInRange<std::size_t>(1, 3));
  for (std::size_t i = 0; i < layers.size(); ++i)
    layers[i] = {static_cast<Um>(200 * (i + 1)), 200, i > 0 && data.ConsumeBool() ? layers[i - 1].regions : regions_from(data)};
  const auto gcode = gcode_of(settings, layers);
  const auto report = audit::examine_text(settings.machine, settings.material, settings.audit, gcode);
  require(report.damaged_count == 0);
  require(report.unaudited_moves == 0);
  require(report.clean());
  if (size % 8 == 0) require(gcode_of(settings, layers) == gcode);
  return 0;
}
