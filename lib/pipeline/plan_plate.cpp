// SPDX-License-Identifier: GPL-3.0-or-later
#include "adhesion/adhesion.h"
#include "audit/audit.h"
#include "gcode/digest.h"
#include "model/sequence.h"
#include "motion/motion.h"
#include "overhangs/overhangs.h"
#include "pipeline/add_raft.h"
#include "pipeline/at_heights.h"
#include "pipeline/change_tool.h"
#include "pipeline/check.h"
#include "pipeline/codec.h"
#include "pipeline/conflicts.h"
#include "pipeline/labels.h"
#include "pipeline/lagging_tower.h"
#include "pipeline/ooze_shield.h"
#include "pipeline/passes.h"
#include "pipeline/place_heat.h"
#include "pipeline/prime_lines.h"
#include "pipeline/sample.h"
#include "pipeline/stages.h"
#include "pipeline/stopwatch.h"
#include "pipeline/support_object.h"
#include "pipeline/vase.h"
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

/// Where a copy's layers come from. What stands under a copy is a copy of its own, which firmware knows as the same.
struct Copy {
  std::size_t of = 0;  ///< index into the lists of layers
  Point by;
  bool last = false;   ///< of that list
  ObjectId label = 0;  ///< of the copy that it is, or stands under
  bool support = false;
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
      copies.push_back({layers.size() - 1, copies[c].by, false, c, true});
    }
    copies.back().last = true;
  }
  for (auto& pass : sequence)
    for (std::size_t i = 0, count = pass.objects.size(); i < count; ++i)
      if (const auto under = below[pass.objects[i]]; under != any_object) pass.objects.push_back(under);
  return sequence;
}

/// The scopes of a raft's layers: speeds of their own are laid over the plate's.
RaftScopes raft_scopes(Scopes& scopes) {
  const auto with = [&](ScopeId below, const char* key, std::optional<double> speed, const char* because) {
    Overlay own{.what = "raft", .scope = Scope::layer};
    if (speed) own.follow(key, *speed, because);
    const Overlay* overlays[] = {&own};
    return scopes.with(below, overlays);
  };
  const RaftSettings& r = scopes[0].raft;
  return {with(scopes.on_first_layer(0), "speed_support_infill", r.raft_base_speed, "raft_base_speed"),
          with(0, "speed_support_infill", r.raft_interface_speed, "raft_interface_speed"),
          with(0, "speed_support_interface", r.raft_surface_speed, "raft_surface_speed")};
}

/// A raft lies under everything, which it lifts; it belongs to no object.
void put_on_raft(Scopes& scopes, Sequence& sequence, std::vector<Copy>& copies, std::vector<PrintedLayers>& layers) {
  const Settings& settings = scopes[0];
  const Um lift = raft_lift(settings);
  if (lift == 0 || sequence.empty()) return;
  Regions standing;
  for (const Copy& copy : copies)
    if (!layers[copy.of].empty())
      for (auto& region : weft::moved(layers[copy.of].front().outline, copy.by)) standing.push_back(std::move(region));
  for (auto& list : layers)
    for (auto& layer : list) layer.z += lift;
  layers.push_back(make_raft(settings, raft_scopes(scopes), standing));
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
                             .over_air = weft::moved(std::move(layer.over_air), copy.by),
                             .support = copy.support});
  }
  return input;
}

/// What of support was printed up to there, or nearly, and is not printed at this moment: where the nozzle would run
/// into what has curled.
Regions standing_support(const TimelineLayer& moment, const std::vector<Copy>& copies,
                         const std::vector<PrintedLayers>& layers) {
  Regions out;
  for (ObjectId id = 0; id < copies.size(); ++id) {
    const Copy& copy = copies[id];
    if (!copy.support ||
        std::any_of(moment.parts.begin(), moment.parts.end(), [&](const auto& part) { return part.object == id; }))
      continue;
    const auto& own = layers[copy.of];
    const auto above =
        std::upper_bound(own.begin(), own.end(), moment.z, [](Um z, const PrintedLayer& layer) { return z < layer.z; });
    if (above == own.begin() || moment.z - std::prev(above)->z >= std::prev(above)->height) continue;
    for (auto& region : weft::moved(std::prev(above)->outline, copy.by)) out.push_back(std::move(region));
  }
  return out;
}

/// Where the nozzle may go on a layer at z.
travel::Room room_at(const MachineSettings& machine, Um z) {
  travel::Room room{reach_area(machine), {}, reach_z_max(machine)};
  if (z < exclude_height(machine)) room.no_go = machine.bed_exclude_areas;
  return room;
}

/// Skirt and brim around everything that rises together, put before the other beads of their layers.
void add_adhesion(const Settings& settings, std::span<travel::LayerInput> rise, const Regions& tower,
                  Notices& notices) {
  constexpr Um thickest = 2000;  // of any layer
  const auto wanted = adhesion_of(settings.adhesion);
  const std::size_t needed = adhesion::layers_needed(wanted);
  if (needed == 0) return;
  std::vector<adhesion::PlateLayer> plate;
  std::vector<travel::LayerInput*> bottoms;  // of each height the first that is printed
  for (auto& layer : rise) {
    const bool around = layer.time.number < needed;
    if (!around && layer.z > thickest) break;
    if (around && layer.time.number == plate.size()) plate.push_back({{}, layer.height}), bottoms.push_back(&layer);
    if (around && plate.back().outlines.empty()) plate.back().outlines = tower;
    for (const auto& object : layer.objects) {
      const auto add = [&](Regions& to) { to.insert(to.end(), object.outline.begin(), object.outline.end()); };
      if (around) add(plate.back().outlines);
      // Of an object whose first layer is thicker than others' the top is higher up.
      const bool lies = layer.z <= (object.height != 0 ? object.height : layer.height);
      if (lies && layer.time.number > 0) add(plate.front().outlines);
    }
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
void add_adhesion_to_rises(const Settings& settings, std::span<travel::LayerInput> layers, const Regions& tower,
                           Notices& notices) {
  for (std::size_t begin = 0; begin < layers.size();) {
    std::size_t end = begin + 1;
    while (end < layers.size() && !layers[end].time.comes_down) ++end;
    add_adhesion(settings, layers.subspan(begin, end - begin), tower, notices);
    begin = end;
  }
}

/// A layer that is done with, until all are.
struct PackedLayer {
  LayerPlan bare;      ///< without steps
  std::string packed;  ///< with them
  gcode::LayerDigest digest;
  Statistics statistics;
  LayerTimes times{};
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

/// What the moves of all layers hang on, beside the beads.
struct MovesOf {
  const Scopes& scopes;
  const ToolScopes& tools;
  const Passes& passes;
  const std::vector<std::vector<Pause>>& pauses;  ///< of each layer
  std::vector<Um> standing;                       ///< of each layer, how high what is printed before it reaches
  const Vase& vase;
};

/// Where each pass begins, as far as it is known: after another tool was loaded the nozzle may be anywhere,
/// and the way to the next object is one over all that stands (go_over).
std::vector<std::optional<Point>> starts_of(const MovesOf& of, const std::vector<travel::Prepared>& prepared,
                                            const std::vector<travel::Ordered>& ordered) {
  std::vector<std::optional<Point>> from(ordered.size());
  if (!from.empty()) from[0] = start_of(of.scopes[0]);
  for (std::size_t p = 1; p < ordered.size(); ++p) {
    from[p] = ordered[p - 1].end ? ordered[p - 1].end : from[p - 1];
    if (of.passes.passes[p].changes || prepared[p].input.time.comes_down) from[p].reset();
  }
  return from;
}

/// The passes of a layer one after the other, with the changes of the tool between them.
LayerPlan joined(const MovesOf& of, std::size_t layer, std::vector<LayerPlan> passes) {
  LayerPlan out = std::move(passes.front());
  for (std::size_t k = 0; k < passes.size(); ++k) {
    LayerPlan& own = k == 0 ? out : passes[k];
    const auto from = k > 0 ? place_behind(out) : std::nullopt;
    if (auto steps = change_before(of.passes, of.passes.begin[layer] + k, of.tools, out, from); !steps.empty())
      put_before(own, std::move(steps));
    if (k > 0)
      out.steps.insert(out.steps.end(), std::make_move_iterator(own.steps.begin()),
                       std::make_move_iterator(own.steps.end()));
  }
  pause_before(out, of.pauses[layer]);
  return out;
}

std::vector<motion::Rules> rules_of(const Scopes& scopes) {
  std::vector<motion::Rules> out;
  for (std::size_t i = 0; i < scopes.size(); ++i) {
    const auto id = static_cast<ScopeId>(i);
    out.push_back(motion::rules_of(scopes[id], &scopes[scopes.above_first_layer(id)]));
  }
  return out;
}

std::vector<overhangs::Strand> strands_of(const Scopes& scopes) {
  std::vector<overhangs::Strand> out;
  for (std::size_t i = 0; i < scopes.size(); ++i) {
    const auto& s = scopes[static_cast<ScopeId>(i)];
    out.push_back({s.machine.nozzle_diameter, s.shells.bridge_flow / 100, s.shells.overhang_walls});
  }
  return out;
}

/// Ways, speeds and times. What a layer was made of is let go of as it goes.
std::vector<PackedLayer> plan_moves(const MovesOf& of, std::vector<travel::Prepared> prepared,
                                    std::vector<travel::Ordered> ordered, Notices& notices, PlanFor use) {
  const auto& scopes = of.scopes;
  const Settings& settings = scopes[0];
  const auto from = starts_of(of, prepared, ordered);
  const auto rules = rules_of(scopes);
  const auto strands = strands_of(scopes);
  std::vector<motion::Rules> of_tools;
  if (of.tools.several())
    for (const auto& tool : of.tools.tools()) of_tools.push_back(motion::rules_of(tool));
  std::vector<travel::Routed> departures(prepared.size());  // without their plans, which go on
  travel::Spiral spiral(settings.layers.smooth_spiralized_contours);
  std::vector<Bead> turns(of.vase.end);  // walls that become turns, by layer
  struct Begun {
    LayerPlan plan;
    std::optional<Point3> start;
    ToolId loaded = any_tool;
  };
  std::optional<Point3> at;
  auto packed = tasks::parallel_linked(
      of.passes.begin.size() - 1,
      [&](std::size_t i) {
        std::vector<LayerPlan> plans;
        for (std::size_t p = of.passes.begin[i]; p < of.passes.begin[i + 1]; ++p) {
          auto layer = std::move(prepared[p]);
          travel::prepare_ways(settings.travel, layer);
          const auto& retraction = scopes[of.tools.several() ? layer.input.scope : 0].retraction;
          auto routed = travel::route(settings.travel, retraction, layer, ordered[p], from[p]);
          lower_tower(of.passes.lag_of(i), routed.plan);
          if (of.vase.has(i)) turns[i] = wall_of(layer.input);
          overhangs::mark(strands, over_air_of(layer.input), routed.plan);
          departures[p].departures = routed.departures;
          plans.push_back(std::move(routed.plan));
        }
        return joined(of, i, std::move(plans));
      },
      [&](std::size_t i, LayerPlan plan) {
        const auto& passes = of.passes;
        if (of.vase.has(i)) wind(of.vase, i, turns[i], spiral, plan);
        const ToolId loaded = i > 0 ? passes.passes[passes.begin[i] - 1].tool : any_tool;
        if (plan.time.comes_down && at) go_over(settings.machine, of.standing[i], *at, plan);
        Begun layer{std::move(plan), at, loaded};
        at = motion::start_after(layer.plan, at);
        return layer;
      },
      [&](std::size_t, Begun layer) {
        auto planned = motion::plan_layer({rules, of_tools, layer.loaded}, std::move(layer.plan), layer.start);
        const auto& plan = planned.plan;
        if (use == PlanFor::figures) return PackedLayer{{plan.z, plan.height, plan.time}, {}, {}, planned.statistics};
        auto times = of_tools.empty() ? LayerTimes{} : times_of(plan, std::move(planned.step_s));
        return PackedLayer{{plan.z, plan.height, plan.time},
                           encode(plan),
                           gcode::digest_of(settings, plan),
                           planned.statistics,
                           std::move(times)};
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

/// Plastic that stands in the melt for minutes creeps upwards: clogs, and none at the next wall.
void tell_slow_ironing(const std::vector<PackedLayer>& layers, Notices& notices) {
  constexpr double long_s = 180, slow_mm3_s = 0.1;
  const PackedLayer* worst = nullptr;
  const auto ironing = [](const PackedLayer& layer) {
    return layer.statistics.features[static_cast<std::size_t>(Role::ironing)];
  };
  for (const auto& layer : layers) {
    const auto own = ironing(layer);
    if (own.s > long_s && own.mm3 < slow_mm3_s * own.s && (worst == nullptr || own.s > ironing(*worst).s))
      worst = &layer;
  }
  if (worst == nullptr) return;
  const auto own = ironing(*worst);
  notices.push_back(
      {"ironing_slow",
       fmt::format("ironing_enabled: at z {:.3f} the nozzle irons for {:.0f} minutes at {:.3f} mm³/s: filament that "
                   "stands in the melt so long may clog; a larger ironing_flow, ironing_line_spacing or speed_ironing "
                   "is quicker through it",
                   to_mm(worst->bare.z), own.s / 60, own.mm3 / own.s)});
}

/// Does one of the first so many objects, which are models, begin there?
bool has_bottom(const TimelineLayer& layer, std::size_t models) {
  return std::any_of(layer.parts.begin(), layer.parts.end(),
                     [&](const auto& part) { return part.object < models && part.layer < Sample::own_kind; });
}

/// What each pass is ordered by, and what all of them have agreed on.
std::pair<std::vector<travel::Prepared>, std::vector<travel::Linked>> prepared_and_linked(
    const TravelSettings& settings, std::vector<travel::LayerInput> inputs) {
  std::vector<travel::Prepared> prepared;
  prepared.reserve(inputs.size());  // they stay where they are
  travel::Linker linker(settings);
  tasks::parallel_in_order(
      inputs.size(), [&](std::size_t i) { return travel::prepare_order(settings, std::move(inputs[i])); },
      [&](std::size_t i, travel::Prepared layer) {
        prepared.push_back(std::move(layer));
        linker.add(prepared[i]);
      });
  auto linked = linker.linked();
  return {std::move(prepared), std::move(linked)};
}

/// Tells each layer its height over the bed, the room there, and what plastic comes of.
void give_room(const Settings& settings, std::vector<travel::LayerInput>& inputs) {
  const double filament_mm = to_mm(settings.material.filament_diameter);
  for (auto& input : inputs) {
    input.z += settings.machine.z_offset;
    input.room = room_at(settings.machine, input.z);
    input.filament_area_mm2 = std::numbers::pi / 4 * filament_mm * filament_mm;
    input.nozzle = settings.machine.nozzle_diameter;
  }
}

}  // namespace

PlannedPlate plan_plate(Scopes& scopes, ToolScopes& tools, const Plate& plate, const Sequence& sequence,
                        std::vector<PrintedLayers> layers, std::vector<SupportOf> supports, Report& report,
                        PlanOptions options) {
  const Stopwatch stopwatch(report.timings_ms[Stage::travel]);
  const auto& settings = scopes[0];
  const ScopeId on_first_layer = scopes.on_first_layer(0);
  auto copies = copies_of(plate);
  auto with_all = with_supports(sequence, std::move(supports), copies, layers);
  put_on_raft(scopes, with_all, copies, layers);
  const auto timeline = timeline_of(with_all, stacks_of(copies, layers));
  const auto read = travel::areas_read(settings.travel);
  const bool around_support = settings.travel.travel_avoid_supports && copies.size() > copies_on(plate);
  auto standing = tasks::parallel_map(timeline.size(), [&](std::size_t i) {
    return around_support ? standing_support(timeline[i], copies, layers) : Regions{};
  });
  auto inputs = tasks::parallel_map(timeline.size(), [&](std::size_t i) {
    auto input = plate_layer(timeline[i], copies, sequence.size() == 1, layers, read);
    input.scope = input.time.first() ? on_first_layer : 0;
    input.support = std::move(standing[i]);
    return input;
  });
  PlannedPlate out;
  auto& plan = out.plan;
  plan.objects = labels_of(plate);
  auto passes = passes_of(settings, tools, scopes, inputs, plan.notices);
  add_adhesion_to_rises(settings, inputs, beside_objects(settings, passes), plan.notices);
  give_adhesion(settings, tools, scopes, inputs);
  add_ooze_shield(settings, passes.shield, passes, inputs);
  add_prime_lines(settings, tools, scopes, passes, inputs, plan.notices);
  give_room(settings, inputs);
  for (auto& notice : check(settings)) plan.notices.push_back(std::move(notice));
  const Vase vase = settings.layers.magic_spiralize ? vase_of(settings, inputs, plan.notices) : Vase{};
  inputs = split(passes, settings, tools, scopes, std::move(inputs));
  check_conflicts(inputs, plan.objects, settings.plate.conflict_tolerance, options.annotate, report.warnings);
  auto [prepared_passes, linked_passes] = prepared_and_linked(settings.travel, std::move(inputs));
  auto& prepared = prepared_passes;  // clang 14 takes no structured binding into a lambda
  const auto& linked = linked_passes;
  auto ordered = tasks::parallel_map(
      prepared.size(), [&](std::size_t i) { return travel::order(settings.travel, prepared[i], linked[i]); });
  if (report.tours) *report.tours = tours_of(prepared, ordered);
  const auto pauses = pauses_of(settings.tools, timeline, plan.notices);
  auto planned = plan_moves({scopes, tools, passes, pauses, heights_before(timeline, settings.machine.z_offset), vase},
                            std::move(prepared), std::move(ordered), plan.notices, options.use);
  out.purged = passes.purged;
  tell_slow_ironing(planned, plan.notices);
  std::vector<LayerTimes> times;
  for (std::size_t i = 0; i < planned.size(); ++i) {
    auto& layer = planned[i];
    if (tools.several()) times.push_back(std::move(layer.times));
    out.statistics.append(layer.statistics);
    if (options.use == PlanFor::figures)
      out.layers.push_back({layer.statistics, has_bottom(timeline[i], copies_on(plate))});
    plan.layers.push_back(std::move(layer.bare));
    out.digests.push_back(std::move(layer.digest));
    out.packed.push_back(std::move(layer.packed));
  }
  if (tools.several() && options.use == PlanFor::writing) place_heat(tools.tools(), times, out);
  return out;
}

}  // namespace weft::pipeline
