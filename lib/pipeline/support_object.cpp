// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/support_object.h"

#include "geometry/boolean.h"
#include "geometry/offset.h"
#include "model/flow.h"
#include "pipeline/fill_support.h"
#include "pipeline/stopwatch.h"
#include "slice/shadow.h"
#include "support/support.h"
#include "tasks/parallel.h"

#include <algorithm>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

using namespace weft::literals;

Regions moved_ring(const Ring& ring, Point by) {
  return weft::moved(Regions{{ring, {}}}, by);
}

/// The print surface less half a bead, as seen from an object whose copies stand at these offsets.
Regions surface_for(const Settings& settings, const Object& object, Um half_bead) {
  const Regions surface = geometry::offset({{print_surface(settings.machine), {}}}, {.by = -half_bead});
  Regions out;
  for (std::size_t i = 0; i < object.copies.size(); ++i) {
    const Regions here = weft::moved(surface, -object.copies[i]);
    out = i == 0 ? here : geometry::intersect(out, here);
  }
  return out;
}

/// What no copy's support may enter.
Regions barred_for(const Settings& settings, const std::vector<Object>& objects, std::size_t of, Um half_bead) {
  Regions out;
  const auto& own = objects[of].copies;
  const Um apart = settings.support.support_xy_distance.of(
                       settings.walls.wall_line_width_0.value_or(settings.machine.nozzle_diameter)) +
                   half_bead;
  for (const Point by : own) {
    for (const Ring& ring : settings.machine.bed_exclude_areas)
      for (auto& region : geometry::offset(moved_ring(ring, -by), {.by = half_bead})) out.push_back(std::move(region));
    for (std::size_t other = 0; other < objects.size(); ++other)
      for (const Point to : objects[other].copies) {
        if (other == of && to == by) continue;
        for (auto& region : geometry::offset(moved_ring(objects[other].hull, to - by), {.by = apart}))
          out.push_back(std::move(region));
      }
  }
  return out.empty() ? out : geometry::unite(out);
}

void tell(const Settings& settings, const Object& object, const support::Figures& figures, Report& report) {
  auto& total = report.support;
  total.needed_mm2 += figures.needed_mm2, total.bridged_mm2 += figures.bridged_mm2;
  total.left_mm2 += figures.left_mm2;
  total.tips += figures.tips, total.trunks += figures.trunks;
  if (figures.left_mm2 < 0.5) return;
  const Point at = Point{figures.left_at.x, figures.left_at.y} + object.copies.front();
  report.warnings.push_back(
      {"support_left", fmt::format("{}: {:.1f} mm² of overhang, first at ({:.3f}, {:.3f}, {:.3f}), cannot be reached{}",
                                   object.name, figures.left_mm2, to_mm(at.x), to_mm(at.y), to_mm(figures.left_at.z),
                                   settings.support.support_type == SupportType::buildplate
                                       ? " from the plate; support_type = everywhere may reach more"
                                       : "")});
}

void tell_missing(const Object& object, const support::Object& outlines, Report& report) {
  const auto islands = support::islands(outlines);
  if (islands.empty()) return;
  const Point at = islands.front().at + object.copies.front();
  const auto* layer = outlines.layers[islands.front().layer];
  report.warnings.push_back(
      {"support_missing",
       fmt::format("{}: {} place{} begin{} in the air, the first at ({:.3f}, {:.3f}, {:.3f}); turn the model, or set "
                   "support_enable = true",
                   object.name, islands.size(), islands.size() == 1 ? "" : "s", islands.size() == 1 ? "s" : "",
                   to_mm(at.x), to_mm(at.y), to_mm(layer->z - layer->height))});
}

bool says_support(const mesh::Mark& mark) {
  return mark.kind == mesh::MarkKind::support_enforcer || mark.kind == mesh::MarkKind::support_blocker ||
         mark.kind == mesh::MarkKind::support;
}
bool has_marks(const Object& object) {
  return std::any_of(object.marks.begin(), object.marks.end(), says_support);
}

/// Volumes and painted facets as areas of layers.
void read_marks(const Settings& settings, const Object& object, const std::vector<slice::Cut>& cuts, SupportOf& out) {
  if (!has_marks(object)) return;
  std::vector<slice::Plane> planes;  // in the middle of layers, as those of the part
  for (const auto& cut : cuts) planes.push_back({cut.layer.z, cut.layer.height, cut.layer.z - cut.layer.height / 2});
  for (const auto& mark : object.marks) {
    if (!says_support(mark)) continue;
    auto& to = mark.kind == mesh::MarkKind::support_enforcer  ? out.enforced
               : mark.kind == mesh::MarkKind::support_blocker ? out.blocked
                                                              : out.given;
    to.resize(planes.size());
    if (mark.painted) {
      auto areas = slice::shadows(mark.mesh, planes);
      for (std::size_t i = 0; i < areas.size(); ++i) to[i].insert(to[i].end(), areas[i].begin(), areas[i].end());
      continue;
    }
    const slice::Cutter cutter(mark.mesh, planes);
    auto marked = tasks::parallel_map(planes.size(), [&](std::size_t i) { return cutter.cut(i, settings.layers); });
    for (std::size_t i = 0; i < marked.size(); ++i)
      to[i].insert(to[i].end(), marked[i].layer.regions.begin(), marked[i].layer.regions.end());
  }
  for (auto* by_layer : {&out.enforced, &out.blocked, &out.given})
    for (auto& regions : *by_layer)
      if (regions.size() > 1) regions = geometry::unite(regions);
}

}  // namespace

bool supports(const Settings& settings) {
  return settings.support.support_enable || settings.support.support_enforce_layers > 0;
}

std::vector<SupportOf> rooms_of(const Scopes& scopes, const Plate& plate) {
  const auto& objects = plate.objects;
  const Settings& settings = scopes[0];
  std::vector<SupportOf> out(objects.size());
  bool any = false;
  for (std::size_t i = 0; i < scopes.size(); ++i) any = any || supports(scopes[static_cast<ScopeId>(i)]);
  if (!any) return out;
  const Um width = settings.support.support_line_width.value_or(settings.machine.nozzle_diameter);
  const Um half_bead = (width + 1) / 2 + 10;  // and what the audit takes for rounding
  for (std::size_t i = 0; i < objects.size(); ++i) {
    out[i].on_raft = settings.adhesion.adhesion_type == AdhesionType::raft;
    if (out[i].on_raft) out[i].floor = -settings.raft.raft_airgap;
    out[i].bounded = settings.support.support_outside == SupportOutside::route;
    if (!out[i].bounded) continue;
    out[i].room = surface_for(settings, objects[i], half_bead);
    const Regions barred = barred_for(settings, objects, i, half_bead);
    if (!barred.empty()) out[i].room = geometry::subtract(out[i].room, barred);
  }
  return out;
}

void support_object(const Scopes& all, const ObjectScopes& scopes, const Object& object,
                    const std::vector<slice::Cut>& cuts, SupportOf& out, Report& report) {
  const ScopeId on_first_layer = scopes.front().of_volume.front();
  const ScopeId above = all.above_first_layer(on_first_layer);
  const Settings& settings = all[above];
  const Stopwatch stopwatch(report.timings_ms[Stage::support]);
  if (supports(settings)) read_marks(settings, object, cuts, out);
  std::vector<const SlicedLayer*> layers;
  Box box;
  for (const auto& cut : cuts) layers.push_back(&cut.layer), box.add(box_of(cut.layer.regions));
  const Um nozzle = settings.machine.nozzle_diameter;
  const support::Object outlines{
      .layers = layers,
      .nozzle = nozzle,
      .outer_line = settings.walls.wall_line_width_0.value_or(flow::automatic_outer_width(nozzle)),
      .floor = out.floor,
      .on_raft = out.on_raft,
      .room = out.bounded ? &out.room : nullptr,
      .enforced = out.enforced,
      .blocked = out.blocked,
      .given = out.given};
  if (!supports(settings)) {
    if (has_marks(object))
      report.warnings.push_back(
          {"support_marks_unused", fmt::format("{}: support that is painted or marked with volumes "
                                               "has no effect: support_enable is off",
                                               object.name)});
    return tell_missing(object, outlines, report);
  }
  const auto demand = support::demand(settings.support, outlines);
  auto plan = support::plan(settings.support, outlines, demand);
  const Point origin = box.empty() ? Point{} : box.centre();
  out.layers = tasks::parallel_map(plan.layers.size(), [&](std::size_t k) {
    auto layer = fill_support(settings, plan.layers[k], origin);
    for (auto& bead : layer.beads) bead.scope = plan.layers[k].first ? on_first_layer : above;
    return layer;
  });
  if (!plan.layers.empty()) out.held = std::move(plan.held);
  tell(settings, object, plan.figures, report);
}

}  // namespace weft::pipeline
