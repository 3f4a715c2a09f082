// SPDX-License-Identifier: GPL-3.0-or-later
#include "model/sequence.h"
#include "pipeline/add_adhesion.h"
#include "pipeline/add_raft.h"
#include "pipeline/at_heights.h"
#include "pipeline/check.h"
#include "pipeline/collect_figures.h"
#include "pipeline/conflicts.h"
#include "pipeline/copies.h"
#include "pipeline/ironing.h"
#include "pipeline/labels.h"
#include "pipeline/ooze_shield.h"
#include "pipeline/passes.h"
#include "pipeline/place_heat.h"
#include "pipeline/plan_moves.h"
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
/// @return what of the bed it covers
Regions put_on_raft(Scopes& scopes, Sequence& sequence, std::vector<Copy>& copies, std::vector<PrintedLayers>& layers) {
  const Settings& settings = scopes[0];
  const Um lift = raft_lift(settings);
  if (lift == 0 || sequence.empty()) return {};
  OnRaft standing;
  for (const Copy& copy : copies) {
    if (layers[copy.of].empty()) continue;
    const PrintedLayer& lowest = layers[copy.of].front();
    if (lowest.z > lowest.height) continue;  // support that stands on the part alone
    auto& to = copy.support ? standing.support : standing.parts;
    for (auto& region : weft::moved(lowest.outline, copy.by)) to.push_back(std::move(region));
  }
  for (auto& list : layers)
    for (auto& layer : list) layer.z += lift;
  layers.push_back(make_raft(settings, raft_scopes(scopes), standing));
  sequence.front().objects.push_back(static_cast<ObjectId>(copies.size()));
  copies.push_back({layers.size() - 1, {}, true, any_object});
  return layers.back().front().outline;
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
                             .support = copy.support,
                             .seams = copy.seams});
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

/// What each copy with a label looks like, and where it stands.
std::vector<contour::Standing> standing_of(const std::vector<contour::Surface>& surfaces,
                                           const std::vector<Copy>& copies, std::size_t count, Um lift) {
  std::vector<contour::Standing> out;
  for (std::size_t i = 0; i < count && !surfaces.empty(); ++i)
    out.push_back({&surfaces[copies[i].of], copies[i].by, lift});
  return out;
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

/// The layers one after the other.
/// @return of each, when its tools are used
std::vector<LayerTimes> put_together(std::vector<PackedLayer> planned, bool keeps_layers, Report& report,
                                     PlannedPlate& out) {
  std::vector<LayerTimes> times;
  std::vector<IronedLayer> ironed;
  std::optional<FigureSum> figures;
  if (report.figures) figures.emplace(*report.figures);
  for (auto& layer : planned) {
    times.push_back(std::move(layer.times));
    out.statistics.append(layer.statistics);
    if (figures && layer.figures) figures->add(layer.bare.z, std::move(*layer.figures), layer.statistics);
    ironed.push_back({layer.bare.z, layer.statistics.features[static_cast<std::size_t>(Role::ironing)]});
    if (keeps_layers) out.layers.push_back({layer.statistics});
    out.plan.layers.push_back(std::move(layer.bare));
    out.digests.push_back(std::move(layer.digest));
    out.packed.push_back(std::move(layer.packed));
  }
  if (figures) figures->finish();
  tell_slow_ironing(ironed, out.plan.notices);
  return times;
}

}  // namespace

PlannedPlate plan_plate(Scopes& scopes, ToolScopes& tools, const Plate& plate, const Sequence& sequence,
                        std::vector<PrintedLayers> layers, std::vector<SupportOf> supports, Report& report,
                        const PlanOptions& options) {
  const Stopwatch stopwatch(report.timings_ms[Stage::travel]);
  const auto& settings = scopes[0];
  const ScopeId on_first_layer = scopes.on_first_layer(0);
  auto copies = copies_of(plate);
  give_seams(scopes, options.feet, copies);
  auto with_all = with_supports(sequence, std::move(supports), copies, layers);
  const Regions raft = put_on_raft(scopes, with_all, copies, layers);
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
  Regions others = beside_objects(settings, passes);
  others.insert(others.end(), raft.begin(), raft.end());
  add_adhesion(scopes, by_copy(options.feet, copies, copies_on(plate)), inputs, others, plan.notices);
  give_adhesion(settings, tools, scopes, inputs);
  add_ooze_shield(settings, passes.shield, passes, inputs);
  add_prime_lines(settings, tools, scopes, passes, inputs, plan.notices);
  give_room(settings, inputs);
  for (auto& notice : check(settings)) plan.notices.push_back(std::move(notice));
  const Vases vases = settings.layers.magic_spiralize ? vases_of(settings, inputs, plan.notices) : Vases{};
  inputs = split(passes, settings, tools, scopes, std::move(inputs));
  check_conflicts(inputs, plan.objects, settings.plate.conflict_tolerance, options.annotate, report.warnings);
  auto [prepared_passes, linked_passes] = prepared_and_linked(settings.travel, std::move(inputs));
  auto& prepared = prepared_passes;  // clang 14 takes no structured binding into a lambda
  const auto& linked = linked_passes;
  auto ordered = tasks::parallel_map(
      prepared.size(), [&](std::size_t i) { return travel::order(settings.travel, prepared[i], linked[i]); });
  if (report.tours) *report.tours = tours_of(prepared, ordered);
  const auto pauses = pauses_of(settings.tools, timeline, plan.notices);
  auto planned = plan_moves(
      {scopes, tools, passes, pauses, heights_before(timeline, settings.machine.z_offset), vases,
       standing_of(options.surfaces, copies, copies_on(plate), raft_lift(settings) + settings.machine.z_offset)},
      std::move(prepared), std::move(ordered), plan.notices, {options.use, report.figures.has_value()});
  out.purged = passes.purged;
  const bool keeps_layers = options.use == PlanFor::figures;
  const auto times = put_together(std::move(planned), keeps_layers, report, out);
  for (std::size_t i = 0; i < out.layers.size(); ++i) out.layers[i].bottom = has_bottom(timeline[i], copies_on(plate));
  if (tools.several() && options.use == PlanFor::writing) place_heat(tools.tools(), times, out);
  return out;
}

}  // namespace weft::pipeline
