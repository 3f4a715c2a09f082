// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/pipeline.h"

#include "adhesion/adhesion.h"
#include "contour/ascend.h"
#include "core/error.h"
#include "core/file_bytes.h"
#include "core/hash.h"
#include "core/stop.h"
#include "gcode/digest.h"
#include "gcode/writer.h"
#include "pipeline/cached.h"
#include "pipeline/collect_figures.h"
#include "pipeline/copies.h"
#include "pipeline/estimate.h"
#include "pipeline/give_back.h"
#include "pipeline/labels.h"
#include "pipeline/model_parts.h"
#include "pipeline/one_at_a_time.h"
#include "pipeline/passes.h"
#include "pipeline/place_heat.h"
#include "pipeline/place_tower.h"
#include "pipeline/plan_moves.h"
#include "pipeline/plate.h"
#include "pipeline/provenance.h"
#include "pipeline/room_around.h"
#include "pipeline/stages.h"
#include "pipeline/stopwatch.h"
#include "pipeline/support_object.h"
#include "pipeline/thumbnails.h"
#include "pipeline/toolpath_pictures.h"
#include "pipeline/vase.h"
#include "pipeline/verdict.h"
#include "settings/catalogue.h"
#include "settings/tools.h"
#include "tasks/parallel.h"
#include "tasks/tasks.h"
#include "tools/purge.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace weft {
namespace {
using namespace pipeline;

/// The most bytes that the text may take, about: what is not used is address space, no memory.
std::size_t room_for(const std::vector<gcode::LayerDigest>& layers) {
  std::size_t bytes = 1U << 16;
  for (const auto& layer : layers) bytes += layer.bytes;
  return bytes;
}

using Heat = decltype(PlannedPlate::heat);

/// The text of the file, audited as it grows. Each layer's steps are unpacked to be written, and let go of: plan and
/// text are never both there as a whole.
void write_gcode(const gcode::Job& job, PrintPlan& plan, std::vector<std::string> packed, const Heat& heat,
                 audit::Check& check, Report& report) {
  const Stopwatch stopwatch(report.timings_ms[Stage::gcode]);
  const gcode::Writer writer(job);
  check.reserve(room_for(job.digests));
  check.add(writer.head());
  const std::string tail = writer.tail();
  const auto let_go = [](auto& list) { std::exchange(list, {}); };  // not `list = {}`: that keeps its room
  GiveBackNowAndThen give_back;
  const auto write = [&](std::size_t i) {
    unpack_steps(packed[i], plan.layers[i]);
    const std::size_t bytes = packed[i].size();
    let_go(packed[i]);
    if (i < heat.size()) add_heat(heat[i], plan.layers[i]);
    auto block = writer.layer(i);
    let_go(plan.layers[i].steps);
    // Here, and not beside the audit: that takes one layer after another, and is what is waited for.
    give_back.let_go_of(bytes);
    return block;
  };
  tasks::parallel_in_order(plan.layers.size(), write, [&](std::size_t, const std::string& block) {
    const Stopwatch audit(report.timings_ms[Stage::audit]);
    check.add(block);
  });
  check.add(tail);
}

/// Each tool has a filament of its own, with a price of its own.
void note_tools(const Settings& settings, const Statistics& s, Report& report) {
  if (s.tools.empty()) return;
  const auto tools = settings_of_tools(settings);
  Cost cost{0, s.print_time_s / 3600 * settings.machine.machine_hourly_cost};
  for (std::size_t i = 0; i < s.tools.size(); ++i) {
    const auto& t = s.tools[i];
    const double filament = i < tools.size() ? t.filament_g / 1000 * tools[i].material.filament_cost : 0;
    cost.filament += filament;
    report.tools.push_back(
        {t.filament_mm, t.filament_mm3, t.filament_g, t.s, filament, t.tower_mm3, static_cast<std::size_t>(t.changes)});
  }
  report.cost = cost.total() > 0 ? std::optional(cost) : std::nullopt;
}

void note_statistics(const Settings& settings, const Statistics& s, Report& report) {
  report.print_time_s = s.print_time_s;
  report.filament_mm = s.filament_mm;
  report.filament_mm3 = s.filament_mm3;
  report.filament_g = s.filament_g;
  report.cost = cost_of(settings.machine, settings.material, s.filament_g, s.print_time_s);
  report.currency = settings.machine.currency;
  for (std::size_t i = 0; i < s.features.size(); ++i)
    report.features[i] = {s.features[i].mm, s.features[i].mm3, s.features[i].s};
  note_tools(settings, s, report);
  report.walls = {static_cast<std::size_t>(s.walls.beads),
                  s.walls.variable_width_mm,
                  s.walls.flow_compensated_mm,
                  s.walls.min_flow_ratio,
                  s.walls.min_width == max_coord ? 0.0 : to_mm(s.walls.min_width),
                  s.walls.over_air_mm,
                  s.walls.whole_over_air_mm};
  report.arcs = {static_cast<std::size_t>(s.arcs.count), static_cast<std::size_t>(s.arcs.pieces), s.arcs.worst_um};
  report.travel = {s.travel.mm, static_cast<std::size_t>(s.travel.moves),
                   static_cast<std::size_t>(s.travel.retractions), static_cast<std::size_t>(s.travel.wall_crossings)};
}

/// The profile's own G-code, so that what is found in it names its setting.
void name_custom_code(const GcodeSettings& g, audit::Check& check) {
  check.custom_code("machine_start_gcode", g.machine_start_gcode);
  check.custom_code("before_layer_gcode", g.before_layer_gcode);
  check.custom_code("layer_gcode", g.layer_gcode);
  check.custom_code("tool_change_gcode", g.tool_change_gcode);
  check.custom_code("machine_extruder_start_code", g.machine_extruder_start_code);
  check.custom_code("machine_extruder_end_code", g.machine_extruder_end_code);
  check.custom_code("pause_gcode", g.pause_gcode);
  check.custom_code("color_change_gcode", g.color_change_gcode);
  check.custom_code("between_objects_gcode", g.between_objects_gcode);
  check.custom_code("machine_end_gcode", g.machine_end_gcode);
}

/// What to do about a model of which nothing is printed.
const char* hint_for_nothing(Point3 size) {
  constexpr Um flat = 10;       // thinner than any slicer's bead or layer
  constexpr Um small = 10'000;  // a part of 10 m, or of 25 cm, drawn in metres or in inches
  if (std::min({size.x, size.y, size.z}) < flat)
    return "it is a surface and no body: give it a thickness where it is drawn";
  if (std::max({size.x, size.y, size.z}) < small)
    return "is it drawn in metres or inches? --scale 1000 or --scale 25.4";
  return "no bead of its settings fits into it: look at layer_height, wall_line_count, line widths and xy_offset";
}

/// A job that prints nothing is not done: a model in metres, or thinner than a layer, would pass every check.
void refuse_emptiness(const std::string& name, const Box3& box, const std::vector<PrintedLayers>& layers) {
  for (const auto& object : layers)
    for (const auto& layer : object)
      if (!layer.beads.empty()) return;
  const auto size = box.size();
  throw Error{Error::Kind::model,
              fmt::format("holds nothing to print: it is {:.3f} × {:.3f} × {:.3f} mm", to_mm(size.x), to_mm(size.y),
                          to_mm(size.z)),
              name, hint_for_nothing(size)};
}

/// What is printed, and what it is called.
struct Printing {
  Plate plate;
  Sequence sequence;
  std::string name;  ///< for messages: of the first model as it was typed, or of the first object
};

/// The plate's steps, and the pictures of it where it is written.
struct Planned {
  PlannedPlate plate;
  std::vector<gcode::Thumbnail> thumbnails;
};

/// Layers that nothing is laid on need no areas, beyond those that adhesion lies around.
void keep(const Sample& sample, std::size_t at_least, PrintedLayers& layers) {
  for (std::size_t i = at_least; i < layers.size(); ++i)
    if (!sample.has(i)) layers[i] = {layers[i].z, layers[i].height, {}, {}, {}, {}, {}, {}};
}

/// The tool of each object: one, so that tools change on the bed only. @throws Error{settings}
std::vector<ToolId> tools_one_at_a_time(const Plate& plate, const std::vector<PrintedLayers>& layers) {
  std::vector<ToolId> out;
  for (std::size_t o = 0; o < layers.size(); ++o) {
    std::set<ToolId> own;
    for (const auto& layer : layers[o])
      for (const auto& bead : layer.beads)
        if (bead.tool != any_tool) own.insert(bead.tool);
    if (own.size() > 1)
      throw Error{Error::Kind::settings,
                  fmt::format("one_at_a_time: '{}' is printed with several tools", plate.objects[o].name),
                  "print_sequence", "print_sequence = all_at_once"};
    out.push_back(own.empty() ? any_tool : *own.begin());
  }
  return out;
}

/// Are layers of an object to follow its surface?
bool follows_surface(const Scopes& scopes, const ObjectScopes& object) {
  return std::any_of(object.begin(), object.end(), [&](const ScopesFrom& from) {
    return std::any_of(from.of_mix.begin(), from.of_mix.end(),
                       [&](ScopeId id) { return scopes[id].layers.z_contouring; });
  });
}

/// What objects look like, where layers are to follow that.
std::vector<contour::Surface> surfaces_of(const Scopes& scopes, const Plate& plate) {
  std::vector<contour::Surface> out;
  bool wanted = false;
  for (std::size_t i = 0; i < scopes.size(); ++i) wanted |= scopes[static_cast<ScopeId>(i)].layers.z_contouring;
  for (std::size_t o = 0; o < plate.objects.size() && wanted; ++o) {
    std::vector<const Mesh*> meshes;
    for (const auto& volume : plate.objects[o].volumes)
      if (volume.kind == VolumeKind::model) meshes.push_back(&volume.mesh);
    out.emplace_back(meshes);
  }
  return out;
}

/// In which order copies are printed: all at once, or one after the other.
Sequence sequence_of(const Scopes& scopes, const ToolScopes& tools, const Plate& plate,
                     const std::vector<ScopeId>& feet, const std::vector<PrintedLayers>& layers,
                     const std::vector<SupportOf>& supports) {
  const Settings& settings = scopes[0];
  if (settings.plate.print_sequence == PrintSequence::all_at_once || copies_on(plate) < 2)
    return by_layer(copies_on(plate));
  const auto tool_of = tools.several() ? tools_one_at_a_time(plate, layers) : std::vector<ToolId>(layers.size());
  const auto labels = labels_of(plate);
  std::vector<Standing> copies;
  for (std::size_t o = 0; o < plate.objects.size(); ++o)
    for (const Point by : plate.objects[o].copies) {
      copies.push_back({labels[copies.size()].name,
                        by,
                        {&layers[o], &supports[o].layers},
                        0,
                        beside_of(scopes[feet[o]]),
                        tool_of[o]});
      for (const auto* list : copies.back().layers)
        for (const auto& layer : *list) copies.back().height = std::max(copies.back().height, layer.z);
    }
  return one_at_a_time(settings, copies);
}

/// Where the copies stand, and what each has of its own.
void note_objects(const Plate& plate, const std::vector<ObjectLabel>& labels, Report& report) {
  std::size_t label = 0;
  for (const auto& object : plate.objects)
    for (std::size_t copy = 0; copy < object.copies.size(); ++copy, ++label) {
      const Point at = labels[label].centre, size = box_of(labels[label].outline).size();
      auto& out = report.objects.emplace_back();
      out = {labels[label].name, {to_mm(at.x), to_mm(at.y)}, {to_mm(size.x), to_mm(size.y)}, {}};
      for (const auto* overlay : {&object.overlay, &object.said})
        for (const auto& laid : overlay->values) out.settings.emplace_back(laid.row->key, laid.origin.text);
    }
}

/// The highest point of what is printed.
Um top_of(const Plate& plate) {
  Um out = 0;
  for (const auto& object : plate.objects)
    for (const auto& volume : object.volumes)
      if (volume.kind == VolumeKind::model) out = std::max(out, box_of(volume.mesh).max.z);
  return out;
}

/// From the plate to its plan.
Planned plan(const Job& job, Printing& what, Running running, PlanFor use) {
  auto& plate = what.plate;
  const bool vase = job.settings.layers.magic_spiralize;
  if (vase) check_vase(job.settings, plate);
  Scopes scopes(vase ? of_vase(job.settings) : job.settings);
  ToolScopes tools(job.settings);
  std::vector<ObjectScopes> of_object;
  for (const auto& object : plate.objects) of_object.push_back(scopes_of(object, tools, scopes));
  // what copies that are told apart have in common is made once
  std::optional<StageCache> common;
  if (tell_copies_apart(scopes, of_object, plate) && running.cache == nullptr)
    running.cache = &common.emplace(CacheOptions{});
  refuse_tower_outside(job.settings, tools, top_of(plate));
  Planned out;
  // Pictures are drawn while the model is sliced.
  const bool of_models = use == PlanFor::writing && job.settings.gcode.thumbnail_content == ThumbnailContent::model;
  tasks::Beside beside([&] {
    if (of_models) out.thumbnails = thumbnails_of(job.settings, plate);
  });
  std::vector<PrintedLayers> layers;
  Box3 box;
  auto supports = rooms_of(scopes, plate);
  auto surfaces = surfaces_of(scopes, plate);
  for (std::size_t o = 0; o < plate.objects.size(); ++o) {
    for (const auto& volume : plate.objects[o].volumes)
      if (volume.kind == VolumeKind::model) box.add(box_of(volume.mesh));
    layers.push_back(print_object(running, scopes, tools, of_object[o], plate.objects[o], supports[o]));
    if (!surfaces.empty() && follows_surface(scopes, of_object[o]))
      tasks::for_each_index(layers.back().size(), [&](std::size_t i) {
        auto& layer = layers.back()[i];
        contour::ascend(surfaces[o], {layer.z, layer.height}, layer.beads);
      });
    keep(running.sample, adhesion::layers_needed(job.settings.adhesion), layers.back());
  }
  beside.wait();
  std::vector<ScopeId> feet;
  for (const auto& own : of_object) feet.push_back(own.front().of_mix.front());
  if (what.sequence.empty()) what.sequence = sequence_of(scopes, tools, plate, feet, layers, supports);
  if (running.report.figures) tell_surface(plate, layers, *running.report.figures);
  for (auto& object : plate.objects)
    for (auto& volume : object.volumes) volume.mesh = {};
  refuse_emptiness(what.name, box, layers);
  give_back_memory();
  begin<Stage::travel>(running.watch);
  auto& report = running.report;
  out.plate = plan_plate(scopes, tools, plate, what.sequence, std::move(layers), std::move(supports), report,
                         {use, std::move(feet), job.audit == audit::Mode::annotate, std::move(surfaces)});
  const auto& plan = out.plate.plan;
  note_objects(plate, plan.objects, report);
  report.layers = plan.layers.size();
  for (const auto& layer : plan.layers)
    report.height_mm = std::max(report.height_mm, to_mm(layer.z - job.settings.machine.z_offset));
  report.warnings.insert(report.warnings.end(), plan.notices.begin(), plan.notices.end());
  return out;
}

/// Files of models, where there are several of one or tools are named, so that the print can be made again.
void note_parts(const Job& job, Report& report) {
  for (std::size_t i = 0; i < job.models.size() && i < report.models.size(); ++i) {
    const auto parts = parts_of(job.models[i]);
    if (parts.size() == 1 && !parts.front().tool) continue;
    for (const auto& part : parts)
      report.models[i].parts.push_back(
          {part.file, parts.size() == 1 ? report.models[i].sha256 : sha256(FileBytes(part.file).view()), part.tool});
  }
}

/// From the plate on.
std::optional<audit::Passed> print(const Job& job, Printing what, const Watch& watch, Report& report,
                                   StageCache* cache) {
  const auto overlays = overlay_lines(what.plate);
  auto planned = plan(job, what, {watch, report, cache}, PlanFor::writing);
  auto& [plan, packed, digests, statistics, layers, heat, cold_at_start, purged] = planned.plate;
  note_statistics(job.settings, statistics, report);
  report.purged = purged;
  begin<Stage::gcode>(watch);
  audit::Check check(job.settings.machine, job.settings.material, job.settings.audit, job.audit, job.settings.plate);
  name_custom_code(job.settings.gcode, check);
  gcode::Job text{
      job.settings,
      plan,
      statistics,
      std::filesystem::path(what.name).stem().string(),
      {},
      provenance_lines(report.models, report.marks, job.placement, job.by_name, report.infill_files) + overlays,
      std::move(digests),
      tool_count(job.settings) > 1 ? settings_of_tools(job.settings) : std::vector<Settings>{},
      std::move(cold_at_start)};
  text.purge_volumes = tools::purge_matrix(text.tools);
  const bool of_models = job.settings.gcode.thumbnail_content == ThumbnailContent::model;
  text.thumbnails = of_models ? std::move(planned.thumbnails) : pictures_of_toolpaths(text, plan, packed);
  write_gcode(text, plan, std::move(packed), heat, check, report);
  begin<Stage::audit>(watch);
  auto passed = verdict_of(check, job, report);
  watch.progress("done", 1.0);
  return passed;
}

/// Objects of fewer layers are planned whole: each is a large share of the print.
constexpr std::size_t few_layers = 24;
/// One of so many, where there are more layers. The other stages read all layers, so that a larger one saves little.
constexpr std::size_t estimate_stride = 4;

/// The layers of the tallest object, about.
std::size_t layers_of(const Settings& settings, const Plate& plate) {
  return static_cast<std::size_t>(top_of(plate) / std::max(settings.layers.layer_height, Um{1}));
}

/// The same without an end, and unless asked for all of them, with beads on some layers only.
std::size_t figure(const Job& job, Printing what, const EstimateOptions& options, const Watch& watch, Report& report,
                   StageCache* cache) {
  const bool all =
      options.exact || job.settings.layers.magic_spiralize || layers_of(job.settings, what.plate) < few_layers;
  const Sample sample{all ? 1 : estimate_stride};
  SampleMeasure measure;
  const auto planned = plan(job, what, {watch, report, cache, sample, &measure}, PlanFor::figures).plate;
  Statistics bottom, above;
  std::size_t count = 0;
  for (const auto& [statistics, is_bottom] : planned.layers) {
    const bool stands = !is_bottom && has_beads(statistics);
    count += is_bottom || stands;
    (stands ? above : bottom).append(statistics);
  }
  note_statistics(job.settings, sample.all() ? planned.statistics : extrapolated(bottom, above, measure), report);
  report.audit.verdict = "unaudited";
  report.status = Report::Status::ok;
  watch.progress("done", 1.0);
  return count;
}

/// `end` of what `prepare` puts on the plate. Typos are told before an hour of slicing.
template <class Prepare, class End>
auto run_stages(const Job& job, const Watch& watch, Report& report, const Prepare& prepare, const End& end) {
  const tasks::ThreadLimit limit(job.threads);
  const StopWhen stop_when(&watch.cancelled);
  try {
    const Stopwatch stopwatch(report.timings_ms.total);
    const std::string settings = as_text(job.settings);
    report.settings_sha256 = sha256(settings);  // of a job whose models cannot be read
    gcode::check_custom_code(job.settings);
    Printing what = prepare();
    if (const auto overlays = overlay_lines(what.plate); !overlays.empty())
      report.settings_sha256 = sha256(settings + overlays);
    return end(std::move(what));
  } catch (const Stopped&) {
    throw Error{Error::Kind::interrupted, "interrupted", {}, "nothing was written"};
  }
}

}  // namespace

std::optional<audit::Passed> run(const Job& job, const Watch& watch, Report& report, StageCache* cache) {
  return run_stages(
      job, watch, report,
      [&] {
        auto plate = place_models(job, report, cache);
        note_parts(job, report);
        return Printing{std::move(plate), {}, parts_of(job.models.front()).front().file};
      },
      [&](Printing what) { return print(job, std::move(what), watch, report, cache); });
}

std::size_t plates_of(const Job& job, const Watch& watch, StageCache* cache) {
  if (!job.placement.plates) return 1;
  Report report;
  return run_stages(
      job, watch, report,
      [&] {
        return Printing{place_models(job, report, cache), {}, {}};
      },
      [&](const Printing&) { return std::max<std::size_t>(report.plates.size(), 1); });
}

std::size_t estimate(const Job& job, const EstimateOptions& options, const Watch& watch, Report& report,
                     StageCache* cache) {
  return run_stages(
      job, watch, report,
      [&] {
        return Printing{place_models(job, report, cache), {}, parts_of(job.models.front()).front().file};
      },
      [&](Printing what) { return figure(job, std::move(what), options, watch, report, cache); });
}

std::optional<audit::Passed> run(const Job& job, Plate plate, const Sequence& sequence, const Watch& watch,
                                 Report& report, StageCache* cache) {
  return run_stages(
      job, watch, report,
      [&] {
        check_printable(plate);
        auto name = plate.objects.front().name;
        return Printing{std::move(plate), sequence, std::move(name)};
      },
      [&](Printing what) { return print(job, std::move(what), watch, report, cache); });
}

}  // namespace weft
