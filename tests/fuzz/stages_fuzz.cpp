// SPDX-License-Identifier: GPL-3.0-or-later
// libFuzzer target for the stages between slices and G-code: random rings, a few layers of them, through walls, shells,
// infill, travel, motion, writer and audit at random settings. No stage throws; every G-code is read by the audit to
// its last line, and the same input gives the same bytes.
//   build/fuzz/tests/fuzz_stages -max_total_time=900 -max_len=512 corpus/
#include "audit/audit.h"
#include "gcode/writer.h"
#include "geometry/boolean.h"
#include "infill/infill.h"
#include "infill/shells.h"
#include "motion/motion.h"
#include "travel/travel.h"
#include "walls/walls.h"

#include <cstdint>
#include <cstdlib>

namespace {

using namespace weft;

void require(bool holds) {
  if (!holds) std::abort();
}

/// Choices taken from bytes in their order; zeros when there are no more.
class Choices {
 public:
  Choices(const std::uint8_t* bytes, std::size_t size) : bytes_(bytes), left_(size) {}
  /// One of low … high.
  int of(int low, int high) {
    const unsigned range = static_cast<unsigned>(high - low) + 1;
    unsigned v = 0;
    for (unsigned reach = 1; reach < range; reach *= 256) v = v * 256 + next();
    return low + static_cast<int>(v % range);
  }
  bool yes() { return of(0, 1) == 1; }

 private:
  unsigned next() {
    if (left_ == 0) return 0;
    --left_;
    return *bytes_++;
  }
  const std::uint8_t* bytes_;
  std::size_t left_;
};

Settings settings_from(Choices& data) {
  Settings s;
  s.machine.home_position = Ring{{0, 0}};
  s.walls.wall_line_count = data.of(0, 6);
  if (data.yes()) s.walls.wall_line_width_0 = data.of(200, 1000);
  s.walls.flow_compensation = data.yes();
  s.shells.top_layers = data.of(0, 3);
  s.shells.bottom_layers = data.of(0, 3);
  s.infill.infill_sparse_density = data.of(0, 100);
  s.infill.infill_pattern = static_cast<InfillPattern>(data.of(0, 4));
  s.retraction.retraction_hop = data.yes() ? 400 : 0;
  s.retraction.wipe = data.yes();
  return s;
}

/// Rings of any shape near the middle of the bed: points at random, some on a coarse grid so that they meet and line
/// up. Within 10 mm, so that a run is short.
Regions regions_from(Choices& data) {
  std::vector<Ring> rings(static_cast<std::size_t>(data.of(1, 4)));
  for (auto& ring : rings) {
    const Um step = data.yes() ? 1 : 250;
    const auto corners = static_cast<std::size_t>(data.of(3, 24));
    for (std::size_t i = 0; i < corners; ++i)
      ring.push_back({100'000 + step * data.of(0, 10'000 / step), 100'000 + step * data.of(0, 10'000 / step)});
  }
  return geometry::regions_from_rings(rings,
                                      data.yes() ? geometry::WindingRule::nonzero : geometry::WindingRule::even_odd);
}

std::string gcode_of(const Settings& s, const std::vector<SlicedLayer>& layers) {
  std::vector<WallLayer> walls;
  for (std::size_t i = 0; i < layers.size(); ++i)
    walls.push_back(
        walls::build(s.walls, {.layer = layers[i], .index = i, .nozzle_diameter = s.machine.nozzle_diameter}));
  std::vector<infill::ShellLayer> seen;
  for (std::size_t i = 0; i < layers.size(); ++i)
    seen.push_back({layers[i].z, layers[i].height, &layers[i].regions, &walls[i].inside});
  const infill::ShellObject object{seen, infill::box_of(seen), s.machine.nozzle_diameter};
  const auto areas = infill::find_areas(s.shells, s.infill, object, 0, seen.size());
  std::vector<travel::LayerInput> inputs(layers.size());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    auto fills = infill::fill(s.infill, s.shells,
                              {.areas = areas[i],
                               .index = i,
                               .z = layers[i].z,
                               .height = layers[i].height,
                               .nozzle = s.machine.nozzle_diameter});
    travel::ObjectLayer one;
    one.outline = layers[i].regions;
    one.beads = std::move(walls[i].beads);
    one.beads.insert(one.beads.end(), fills.beads.begin(), fills.beads.end());
    inputs[i].time.index = inputs[i].time.number = static_cast<std::uint32_t>(i);
    inputs[i].z = layers[i].z, inputs[i].height = layers[i].height;
    inputs[i].objects.push_back(std::move(one));
  }
  PrintPlan plan;
  plan.objects.push_back({"fuzz", {100'000, 100'000}, {}});
  plan.layers = travel::plan(s.travel, s.retraction, std::move(inputs));
  const auto rules = motion::rules_of(s);
  const auto starts = motion::starts_of(plan);
  Statistics statistics;
  for (std::size_t i = 0; i < plan.layers.size(); ++i) {
    auto planned = motion::plan_layer(rules, std::move(plan.layers[i]), starts[i]);
    plan.layers[i] = std::move(planned.plan);
    statistics.append(planned.statistics);
  }
  return gcode::write({s, plan, statistics, "fuzz", {}});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  Choices data(bytes, size);
  const auto settings = settings_from(data);
  std::vector<SlicedLayer> layers(static_cast<std::size_t>(data.of(1, 3)));
  for (std::size_t i = 0; i < layers.size(); ++i)
    layers[i] = {static_cast<Um>(200 * (i + 1)), 200, i > 0 && data.yes() ? layers[i - 1].regions : regions_from(data)};
  const auto gcode = gcode_of(settings, layers);
  const auto report = audit::examine_text(settings.machine, settings.material, settings.audit, gcode);
  require(report.damaged_count == 0);
  require(report.unaudited_moves == 0);
  require(report.clean() || report.empty());  // of what walls make no bead there is no move
  if (size % 8 == 0) require(gcode_of(settings, layers) == gcode);
  return 0;
}
