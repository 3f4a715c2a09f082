// SPDX-License-Identifier: GPL-3.0-or-later
#include "adhesion/adhesion.h"
#include "audit/audit.h"
#include "gcode/digest.h"
#include "model/sequence.h"
#include "motion/motion.h"
#include "overhangs/overhangs.h"
#include "pipeline/add_raft.h"
#include "pipeline/check.h"
#include "pipeline/codec.h"
#include "pipeline/sample.h"
#include "pipeline/stages.h"
#include "pipeline/stopwatch.h"
#include "pipeline/support_object.h"
#include "tasks/parallel.h"
#include "travel/travel.h"

#include <algorithm>
#include <iterator>
#include <numbers>
#include <span>
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
std::vector<ObjectLabel> labels_of(const Plate& plate) {
  std::vector<ObjectLabel> out;
  for (const auto& object : plate.objects) {
    for (std::size_t copy = 0; copy < object.copies.size(); ++copy) {
      Ring outline = object.hull;
      for (auto& p : outline) p = p + object.copies[copy];
      const Point centre = box_of(outline).centre();
      out.push_back({object.copies.size() == 1 ? object.name : fmt::format("{}_{}", object.name, copy + 1), centre,
                     std::move(outline)});
    }
  }
  return out;
}

/// Where a copy's layers come from. What stands under a copy is a copy of its own, which firmware knows as the same.
struct Copy {
  std::size_t of = 0;  ///< index into the lists of layers
  Point by;
  bool last = false;   ///< of that list
  ObjectId label = 0;  ///< of the copy that it is, or stands under
};
std::vector<Copy> copies_of(const Plate& plate) {
  std::vector<Copy> out;
  for (std::size_t o = 0; o < plate.objects.size(); ++o) {
    for (const Point by : plate.objects[o].copies) out.push_back({o, by, false, static_cast<ObjectId>(out.size())});
    if (!plate.objects[o].copies.empty()) out.back().last = true;
  }
  return out;
}

constexpr ObjectId any_object = ~ObjectId{0};  // none

/// Support goes with the copies that it stands under: its layers and copies follow those of the objects.
Sequence with_supports(Sequence sequence, std::vector<SupportOf> supports, std::vector<Copy>& copies,
                       std::vector<PrintedLayers>& layers) {
  const std::size_t own = copies.size();
  std::vector<ObjectId> below(own, any_object);
  for (std::size_t o = 0; o < supports.size(); ++o) {
    if (supports[o].layers.empty()) continue;
    layers.push_back(std::move(supports[o].layers));
    for (ObjectId c = 0; c < own; ++c) {
      if (copies[c].of != o) continue;
      below[c] = static_cast<ObjectId>(copies.size());
      copies.push_back({layers.size() - 1, copies[c].by, false, c});
    }
    copies.back().last = true;
  }
  for (auto& pass : sequence)
    for (std::size_t i = 0, count = pass.objects.size(); i < count; ++i)
      if (const auto under = below[pass.objects[i]]; under != any_object) pass.objects.push_back(under);
  return sequence;
}

/// A raft lies under everything, which it lifts; it belongs to no object.
void put_on_raft(const Settings& settings, Sequence& sequence, std::vector<Copy>& copies,
                 std::vector<PrintedLayers>& layers) {
  const Um lift = raft_lift(settings);
  if (lift == 0 || sequence.empty()) return;
  Regions standing;
  for (const Copy& copy : copies)
    if (!layers[copy.of].empty())
      for (auto& region : weft::moved(layers[copy.of].front().outline, copy.by)) standing.push_back(std::move(region));
  for (auto& list : layers)
    for (auto& layer : list) layer.z += lift;
  layers.push_back(make_raft(settings, standing));
  sequence.front().objects.push_back(static_cast<ObjectId>(copies.size()));
  copies.push_back({layers.size() - 1, {}, true, any_object});
}

/// Objects whose layers begin alike are one stack: it is as high as the tallest of them.
std::vector<Stack> stacks_of(const std::vector<Copy>& copies, const std::vector<PrintedLayers>& layers) {
  std::vector<Stack> out;
  for (ObjectId id = 0; id < copies.size(); ++id) {
    std::vector<LayerHeight> own;
    for (const auto& layer : layers[copies[id].of]) own.push_back({layer.z, layer.height});
    const auto alike = [&](const Stack& stack) {
      return std::equal(own.begin(),
                        own.begin() + static_cast<std::ptrdiff_t>(std::min(own.size(), stack.layers.size())),
                        stack.layers.begin());
    };
    auto stack = std::find_if(out.begin(), out.end(), alike);
    if (stack == out.end()) stack = out.insert(out.end(), Stack{});
    stack->objects.push_back({id, static_cast<std::uint32_t>(own.size())});
    if (own.size() > stack->layers.size()) stack->layers = std::move(own);
  }
  return out;
}

/// All that is printed at one moment. Where no other moment needs it, the last copy takes what the object's layer
/// holds.
travel::LayerInput plate_layer(const TimelineLayer& moment, const std::vector<Copy>& copies, bool only_use,
                               std::vector<PrintedLayers>& layers, const travel::AreasRead& read) {
  travel::LayerInput input;
  input.time = moment.time;
  input.z = moment.z;
  input.height = moment.height;
  for (const auto& part : moment.parts) {
    const auto& copy = copies[part.object];
    auto& kept = layers[copy.of][part.layer];
    auto layer = copy.last && only_use ? std::move(kept) : kept;
    if (copy.label == any_object) {
      input.adhesion = std::move(layer.beads);
      continue;
    }
    input.objects.push_back({.object = copy.label,
                             .stack = part.stack,
                             .height = layer.height,
                             .beads = moved(std::move(layer.beads), copy.by),
                             .outline = weft::moved(std::move(layer.outline), copy.by),
                             .skin = read.skin ? weft::moved(std::move(layer.skin), copy.by) : Regions{},
                             .top = read.top ? weft::moved(std::move(layer.top), copy.by) : Regions{},
                             .sparse = read.sparse ? weft::moved(std::move(layer.sparse), copy.by) : Regions{},
                             .over_air = weft::moved(std::move(layer.over_air), copy.by)});
  }
  return input;
}

/// Where the nozzle may go on a layer at z.
travel::Room room_at(const MachineSettings& machine, Um z) {
  travel::Room room{reach_area(machine), {}, reach_z_max(machine)};
  if (z < exclude_height(machine)) room.no_go = machine.bed_exclude_areas;
  return room;
}

/// Skirt and brim around everything that rises together, put before the other beads of their layers.
void add_adhesion(const Settings& settings, std::span<travel::LayerInput> rise, Notices& notices) {
  const auto wanted = adhesion_of(settings.adhesion);
  const std::size_t needed = adhesion::layers_needed(wanted);
  if (needed == 0) return;
  std::vector<adhesion::PlateLayer> plate;
  std::vector<travel::LayerInput*> bottoms;  // of each height the first that is printed
  for (auto& layer : rise) {
    if (layer.time.number >= needed) break;
    if (layer.time.number == plate.size()) plate.push_back({{}, layer.height}), bottoms.push_back(&layer);
    auto& outlines = plate.back().outlines;
    for (const auto& object : layer.objects)
      outlines.insert(outlines.end(), object.outline.begin(), object.outline.end());
  }
  const Ring surface = print_surface(settings.machine);
  auto built =
      adhesion::build(wanted, {.layers = plate, .nozzle = settings.machine.nozzle_diameter, .print_surface = &surface});
  for (std::size_t i = 0; i < built.layers.size(); ++i) {
    bottoms[i]->adhesion = std::move(built.layers[i]);
    for (auto& bead : bottoms[i]->adhesion) bead.scope = bottoms[i]->scope;
  }
  std::move(built.notices.begin(), built.notices.end(), std::back_inserter(notices));
}
void add_adhesion_to_rises(const Settings& settings, std::span<travel::LayerInput> layers, Notices& notices) {
  for (std::size_t begin = 0; begin < layers.size();) {
    std::size_t end = begin + 1;
    while (end < layers.size() && !layers[end].time.comes_down) ++end;
    add_adhesion(settings, layers.subspan(begin, end - begin), notices);
    begin = end;
  }
}

/// A layer that is done with, until all are.
struct PackedLayer {
  LayerPlan bare;      ///< without steps
  std::string packed;  ///< with them
  gcode::LayerDigest digest;
  Statistics statistics;
};

/// Where the start G-code leaves the nozzle, where the first travel must know it: round no-go areas and notches.
std::optional<Point> start_of(const Settings& settings) {
  const auto& m = settings.machine;
  const bool open = m.bed_exclude_areas.empty() && m.bed_shape != BedShape::polygon && m.machine_reach.size() <= 2;
  return open ? std::nullopt : audit::place_after(m, settings.gcode.machine_start_gcode);
}

/// Of all objects of a layer.
Regions over_air_of(travel::LayerInput& input) {
  Regions out;
  for (auto& object : input.objects) std::move(object.over_air.begin(), object.over_air.end(), std::back_inserter(out));
  return out;
}

/// Ways, speeds and times. What a layer was made of is let go of as it goes.
std::vector<PackedLayer> plan_moves(const Scopes& scopes, std::vector<travel::Prepared> prepared,
                                    std::vector<travel::Ordered> ordered, Notices& notices, PlanFor use) {
  const std::size_t count = prepared.size();
  const Settings& settings = scopes[0];
  std::vector<std::optional<Point>> from(count);
  if (count > 0) from[0] = start_of(settings);
  for (std::size_t i = 1; i < count; ++i) from[i] = ordered[i - 1].end ? ordered[i - 1].end : from[i - 1];
  std::vector<motion::Rules> rules;
  std::vector<overhangs::Strand> strands;
  for (std::size_t i = 0; i < scopes.size(); ++i) {
    const auto id = static_cast<ScopeId>(i);
    rules.push_back(motion::rules_of(scopes[id], &scopes[scopes.above_first_layer(id)]));
    strands.push_back({scopes[id].machine.nozzle_diameter, scopes[id].shells.bridge_flow / 100});
  }
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
        auto routed = travel::route(settings.travel, settings.retraction, layer, ordered[i], from[i]);
        overhangs::mark(strands, over_air_of(layer.input), routed.plan);
        return routed;
      },
      [&](std::size_t i, travel::Routed routed) {
        departures[i].departures = routed.departures;
        Begun layer{std::move(routed.plan), at};
        at = motion::start_after(layer.plan, at);
        return layer;
      },
      [&](std::size_t, Begun layer) {
        const auto planned = motion::plan_layer(rules, std::move(layer.plan), layer.start);
        const auto& plan = planned.plan;
        if (use == PlanFor::figures) return PackedLayer{{plan.z, plan.height, plan.time}, {}, {}, planned.statistics};
        return PackedLayer{
            {plan.z, plan.height, plan.time}, encode(plan), gcode::digest_of(settings, plan), planned.statistics};
      });
  for (auto& notice : travel::notices_of(departures)) notices.push_back(std::move(notice));
  return packed;
}

/// How near the order of each layer is to the shortest.
std::vector<Report::Tour> tours_of(const std::vector<travel::Prepared>& prepared,
                                   const std::vector<travel::Ordered>& ordered) {
  return tasks::parallel_map(prepared.size(), [&](std::size_t i) {
    const auto gap = travel::gap_of(prepared[i], ordered[i], i > 0 ? ordered[i - 1].end : std::nullopt);
    return Report::Tour{gap.way_um / 1000, gap.least_um / 1000};
  });
}

/// Does one of the first so many objects, which are models, begin there?
bool has_bottom(const TimelineLayer& layer, std::size_t models) {
  return std::any_of(layer.parts.begin(), layer.parts.end(),
                     [&](const auto& part) { return part.object < models && part.layer < Sample::own_kind; });
}

}  // namespace

PlannedPlate plan_plate(Scopes& scopes, const Plate& plate, const Sequence& sequence, std::vector<PrintedLayers> layers,
                        std::vector<SupportOf> supports, Report& report, PlanFor use) {
  const Stopwatch stopwatch(report.timings_ms[Stage::travel]);
  const ScopeId on_first_layer = scopes.on_first_layer(0);
  const Settings& settings = scopes[0];
  auto copies = copies_of(plate);
  auto with_all = with_supports(sequence, std::move(supports), copies, layers);
  put_on_raft(settings, with_all, copies, layers);
  const auto timeline = timeline_of(with_all, stacks_of(copies, layers));
  const std::size_t count = timeline.size();
  const auto read = travel::areas_read(settings.travel);
  auto inputs = tasks::parallel_map(count, [&](std::size_t i) {
    auto input = plate_layer(timeline[i], copies, sequence.size() == 1, layers, read);
    input.scope = input.time.first() ? on_first_layer : 0;
    for (auto& bead : input.adhesion) bead.scope = input.scope;
    return input;
  });

  PlannedPlate out;
  auto& plan = out.plan;
  plan.objects = labels_of(plate);
  add_adhesion_to_rises(settings, inputs, plan.notices);
  const double filament_mm = to_mm(settings.material.filament_diameter);
  for (auto& input : inputs) {
    input.z += settings.machine.z_offset;
    input.room = room_at(settings.machine, input.z);
    input.filament_area_mm2 = std::numbers::pi / 4 * filament_mm * filament_mm;
    input.nozzle = settings.machine.nozzle_diameter;
  }
  for (auto& notice : check(settings)) plan.notices.push_back(std::move(notice));

  std::vector<travel::Prepared> prepared;
  prepared.reserve(count);
  travel::Linker linker(settings.travel);
  tasks::parallel_in_order(
      count, [&](std::size_t i) { return travel::prepare_order(settings.travel, std::move(inputs[i])); },
      [&](std::size_t i, travel::Prepared layer) {
        prepared.push_back(std::move(layer));
        linker.add(prepared[i]);
      });
  const auto linked = linker.linked();
  auto ordered =
      tasks::parallel_map(count, [&](std::size_t i) { return travel::order(settings.travel, prepared[i], linked[i]); });
  if (report.tours) *report.tours = tours_of(prepared, ordered);
  auto planned = plan_moves(scopes, std::move(prepared), std::move(ordered), plan.notices, use);
  for (std::size_t i = 0; i < planned.size(); ++i) {
    auto& layer = planned[i];
    out.statistics.append(layer.statistics);
    if (use == PlanFor::figures) out.layers.push_back({layer.statistics, has_bottom(timeline[i], copies_on(plate))});
    plan.layers.push_back(std::move(layer.bare));
    out.digests.push_back(std::move(layer.digest));
    out.packed.push_back(std::move(layer.packed));
  }
  return out;
}

}  // namespace weft::pipeline
