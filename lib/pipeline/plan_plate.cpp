#include "adhesion/adhesion.h"
#include "gcode/digest.h"
#include "motion/motion.h"
#include "pipeline/codec.h"
#include "pipeline/stages.h"
#include "pipeline/stopwatch.h"
#include "tasks/parallel.h"
#include "travel/travel.h"

#include <algorithm>
#include <iterator>
#include <numbers>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

Beads moved(Beads beads, Point by) {
  for (auto& bead : beads)
    for (auto& junction : bead.path) junction.at = junction.at + by;
  return beads;
}

/// What firmware is told of each copy.
std::vector<ObjectLabel> labels_of(const std::vector<PlacedObject>& objects) {
  std::vector<ObjectLabel> out;
  for (const auto& object : objects) {
    for (std::size_t copy = 0; copy < object.offsets.size(); ++copy) {
      Ring outline = object.hull;
      for (auto& p : outline) p = p + object.offsets[copy];
      const Point centre = box_of(outline).centre();
      out.push_back({object.offsets.size() == 1 ? object.name : fmt::format("{}_{}", object.name, copy + 1), centre,
                     std::move(outline)});
    }
  }
  return out;
}

/// All copies of all objects at one height. Objects end at different heights; layers are those of the tallest. The last
/// copy of an object takes what the layer holds.
travel::LayerInput plate_layer(const std::vector<PlacedObject>& objects, std::vector<PrintedLayers>& layers,
                               const travel::AreasRead& read, std::size_t index) {
  travel::LayerInput input;
  input.index = index;
  std::uint32_t label = 0;
  for (std::size_t o = 0; o < objects.size(); ++o) {
    const auto& offsets = objects[o].offsets;
    for (std::size_t copy = 0; copy < offsets.size(); ++copy) {
      const auto object = label++;
      if (index >= layers[o].size()) continue;
      auto& kept = layers[o][index];
      auto layer = copy + 1 < offsets.size() ? kept : std::move(kept);
      const Point by = offsets[copy];
      input.z = layer.z;
      input.height = layer.height;
      input.objects.push_back({object, moved(std::move(layer.beads), by), weft::moved(std::move(layer.outline), by),
                               read.skin ? weft::moved(std::move(layer.skin), by) : Regions{},
                               read.top ? weft::moved(std::move(layer.top), by) : Regions{},
                               read.sparse ? weft::moved(std::move(layer.sparse), by) : Regions{}});
    }
  }
  return input;
}

/// Where the nozzle may go on a layer at z.
travel::Room room_at(const MachineSettings& machine, Um z) {
  travel::Room room{reach_area(machine), {}, reach_z_max(machine)};
  if (z < exclude_height(machine)) room.no_go = machine.bed_exclude_areas;
  return room;
}

/// Skirt and brim around everything, put before the other beads of their layers.
void add_adhesion(const Settings& settings, std::vector<travel::LayerInput>& layers, Notices& notices) {
  const std::size_t count = std::min(layers.size(), adhesion::layers_needed(settings.adhesion));
  std::vector<adhesion::PlateLayer> plate(count);
  for (std::size_t i = 0; i < count; ++i) {
    plate[i].height = layers[i].height;
    for (const auto& object : layers[i].objects)
      plate[i].outlines.insert(plate[i].outlines.end(), object.outline.begin(), object.outline.end());
  }
  const Ring surface = print_surface(settings.machine);
  auto built = adhesion::build(
      settings.adhesion, {.layers = plate, .nozzle = settings.machine.nozzle_diameter, .print_surface = &surface});
  for (std::size_t i = 0; i < built.layers.size(); ++i) layers[i].adhesion = std::move(built.layers[i]);
  std::move(built.notices.begin(), built.notices.end(), std::back_inserter(notices));
}

/// A layer that is done with, until all are.
struct PackedLayer {
  LayerPlan bare;      ///< without steps
  std::string packed;  ///< with them
  gcode::LayerDigest digest;
  Statistics statistics;
};

/// Ways, speeds and times. What a layer was made of is let go of as it goes.
std::vector<PackedLayer> plan_moves(const Settings& settings, std::vector<travel::Prepared> prepared,
                                    std::vector<travel::Ordered> ordered, Notices& notices, PlanFor use) {
  const std::size_t count = prepared.size();
  std::vector<std::optional<Point>> from(count);
  for (std::size_t i = 1; i < count; ++i) from[i] = ordered[i - 1].end ? ordered[i - 1].end : from[i - 1];
  const auto rules = motion::rules_of(settings);
  std::vector<travel::Routed> departures(count);  // without their plans, which go on
  struct Begun {
    LayerPlan plan;
    std::optional<Point3> start;
  };
  std::optional<Point3> at;
  auto packed = tasks::parallel_linked(
      count,
      [&](std::size_t i) {
        auto layer = std::move(prepared[i]);
        travel::prepare_ways(settings.travel, layer);
        return travel::route(settings.travel, settings.retraction, layer, ordered[i], from[i]);
      },
      [&](std::size_t i, travel::Routed routed) {
        departures[i].departures = routed.departures;
        Begun layer{std::move(routed.plan), at};
        at = motion::start_after(layer.plan, at);
        return layer;
      },
      [&](std::size_t i, Begun layer) {
        const auto planned = motion::plan_layer(rules, std::move(layer.plan), i, layer.start);
        const auto& plan = planned.plan;
        if (use == PlanFor::figures) return PackedLayer{{plan.z, plan.height}, {}, {}, planned.statistics};
        return PackedLayer{{plan.z, plan.height}, encode(plan), gcode::digest_of(settings, plan), planned.statistics};
      });
  for (auto& notice : travel::notices_of(departures)) notices.push_back(std::move(notice));
  return packed;
}

}  // namespace

PlannedPlate plan_plate(const Settings& settings, const std::vector<PlacedObject>& objects,
                        std::vector<PrintedLayers> layers, Report& report, PlanFor use) {
  const Stopwatch stopwatch(report.timings_ms.travel);
  std::size_t count = 0;
  for (const auto& object : layers) count = std::max(count, object.size());
  const auto read = travel::areas_read(settings.travel);
  auto inputs = tasks::parallel_map(count, [&](std::size_t i) { return plate_layer(objects, layers, read, i); });

  PlannedPlate out;
  auto& plan = out.plan;
  plan.objects = labels_of(objects);
  add_adhesion(settings, inputs, plan.notices);
  const double filament_mm = to_mm(settings.material.filament_diameter);
  for (auto& input : inputs) {
    input.room = room_at(settings.machine, input.z);
    input.filament_area_mm2 = std::numbers::pi / 4 * filament_mm * filament_mm;
  }
  for (auto& notice : travel::check(settings.travel, settings.retraction)) plan.notices.push_back(std::move(notice));

  std::vector<travel::Prepared> prepared;
  prepared.reserve(count);
  travel::Linker linker(settings.travel);
  tasks::parallel_in_order(
      count, [&](std::size_t i) { return travel::prepare_order(settings.travel, std::move(inputs[i])); },
      [&](std::size_t i, travel::Prepared layer) {
        prepared.push_back(std::move(layer));
        linker.add(prepared[i], i > 0 ? &prepared[i - 1] : nullptr);
      });
  const auto linked = linker.linked();
  auto ordered =
      tasks::parallel_map(count, [&](std::size_t i) { return travel::order(settings.travel, prepared[i], linked[i]); });
  auto planned = plan_moves(settings, std::move(prepared), std::move(ordered), plan.notices, use);
  for (auto& layer : planned) {
    out.statistics.append(layer.statistics);
    if (use == PlanFor::figures) out.layer_statistics.push_back(layer.statistics);
    plan.layers.push_back(std::move(layer.bare));
    out.digests.push_back(std::move(layer.digest));
    out.packed.push_back(std::move(layer.packed));
  }
  return out;
}

}  // namespace weft::pipeline
