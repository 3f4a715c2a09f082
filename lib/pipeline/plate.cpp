// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/plate.h"

#include "core/error.h"
#include "mesh/placement.h"
#include "pipeline/arranged.h"
#include "pipeline/plate_builder.h"
#include "pipeline/read_models.h"
#include "pipeline/room_around.h"
#include "pipeline/stopwatch.h"
#include "pipeline/transform_models.h"
#include "pipeline/transform_words.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace weft::pipeline {
namespace {

mesh::PlacementOptions options_of(const Job& job, bool turned) {
  const auto& p = job.placement;
  // One at a time the head needs room beside what stands.
  return {.stretch_xy = job.settings.material.material_shrinkage_percentage_xy / 100,
          .stretch_z = job.settings.material.material_shrinkage_percentage_z / 100,
          .rotate_deg = turned ? 0 : p.rotate_deg,
          .keep_position = p.keep_position,
          .drop = p.drop,
          .center = p.centre,
          .copies = p.copies,
          .spacing = std::max(p.spacing, apart_of(job.settings)) + 2 * wider_of(job.settings)};
}

mesh::Plate bed_of(const Job& job) {
  const auto& machine = job.settings.machine;
  return {print_surface(machine), machine.bed_exclude_areas, height_of(machine)};
}

std::vector<Typed> read_and_transformed(const Job& job, Report& report, StageCache* cache) {
  const auto& transform = job.placement.transform;
  auto typed = read_models(job, report, cache);
  const bool turned = transforms(transform);
  if (turned || transform.mm_per_unit != 1)
    for (auto& model : report.models) tell_transforms(job.placement, model);
  if (turned) typed = transformed(job.settings, job.placement, std::move(typed), report.models);
  return typed;
}

/// Plates of a project of OrcaSlicer or BambuStudio lie in a grid: columns to the right, rows to the front, each a
/// fifth of the bed apart. What keeps its position keeps it on its own plate.
void onto_its_plate(const Job& job, mesh::Loaded& model) {
  if (model.author != mesh::Author::orca || model.plates.size() < 2 || job.placement.plate < 2) return;
  const auto columns = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(model.plates.size()))));
  const int index = job.placement.plate - 1;
  const Point bed = weft::box_of(print_surface(job.settings.machine)).size();
  const auto stride = [](Um size) { return size + size / 5; };
  const Point3 by{-(index % columns) * stride(bed.x), (index / columns) * stride(bed.y), 0};
  for (auto& object : model.objects) {
    object.mesh = mesh::moved(std::move(object.mesh), by);
    for (auto& mark : object.marks) mark.mesh = mesh::moved(std::move(mark.mesh), by);
  }
}

}  // namespace

Plate place_models(const Job& job, Report& report, StageCache* cache) {
  const Stopwatch stopwatch(report.timings_ms[Stage::read]);
  auto typed = read_and_transformed(job, report, cache);
  if (job.placement.keep_position)
    for (auto& each : typed) onto_its_plate(job, each.model);
  PlateBuilder builder(job, typed, report);
  const auto together = builder.together();
  auto options = options_of(job, transforms(job.placement.transform));
  if (job.placement.by_outlines())
    options.arranger = [&](std::span<const mesh::ToPlace> models, const mesh::Plate& free) {
      return arranged(job, models, free, report);
    };
  std::vector<mesh::Loaded> taken;
  for (const auto& each : together) {
    taken.push_back(builder.take(each));
    options.of_model.push_back(each.own);
  }
  const auto bed = bed_of(job);
  auto placed = mesh::place(std::move(taken), options, bed);
  // What does not fit is told before an hour of slicing; to annotate, the audit must see it.
  if (job.audit == audit::Mode::reject) mesh::check_fits(placed, bed, job.settings.audit.audit_tolerance);
  for (auto& model : placed) {
    const auto& what = together[model.number];
    builder.put(what, std::move(model));
  }
  return std::move(builder).plate();
}

}  // namespace weft::pipeline
