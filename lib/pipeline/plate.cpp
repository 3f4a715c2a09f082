// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/plate.h"

#include "core/file_bytes.h"
#include "mesh/placement.h"
#include "mesh/read.h"
#include "pipeline/cached.h"
#include "pipeline/stopwatch.h"
#include "preview/thumbnail.h"
#include "tasks/parallel.h"

#include <filesystem>
#include <iterator>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

std::string name_of(const mesh::Loaded& model, std::size_t object) {
  const auto& own = model.objects[object].name;
  if (!own.empty()) return own;
  const auto stem = std::filesystem::path(model.path).stem().string();
  return model.objects.size() == 1 ? stem : fmt::format("{}_{}", stem, object + 1);
}

void note_model(const mesh::Loaded& model, Report& report) {
  Report::Model out{model.path, model.sha256, 0, 0.0, {}};
  report.warnings.insert(report.warnings.end(), model.notices.begin(), model.notices.end());
  for (std::size_t i = 0; i < model.objects.size(); ++i) {
    const auto& object = model.objects[i];
    out.triangles += object.mesh.triangles.size();
    out.volume_mm3 += volume_mm3(object.mesh);
    for (auto& notice : mesh::notices_of(object.repairs, name_of(model, i))) {
      out.repairs.push_back(notice.message);
      report.warnings.push_back(std::move(notice));
    }
  }
  report.models.push_back(std::move(out));
}

/// A model, welded and repaired. Messages name it as it was typed, so that name is part of the key.
mesh::Loaded read_model(const std::string& path, double scale, StageCache* cache) {
  if (!cache) return mesh::read_file(path, {.scale = scale});
  const FileBytes file(path);
  const auto hash = sha256(file.view());
  return cached(
             cache, [&] { return StageKey(row_of<Stage::read>()).with(path).with(hash).with(scale); },
             [&] { return mesh::read(file.view(), path, {.scale = scale, .sha256 = hash}); })
      .take();
}

}  // namespace

Plate place_models(const Job& job, Report& report, StageCache* cache) {
  const Stopwatch stopwatch(report.timings_ms[Stage::read]);
  auto loaded = tasks::parallel_map(
      job.models.size(), [&](std::size_t i) { return read_model(job.models[i], job.placement.scale, cache); });
  Plate out;
  for (const auto& model : loaded) {
    note_model(model, report);
    for (std::size_t i = 0; i < model.objects.size(); ++i) out.objects.push_back({name_of(model, i), {Volume{}}});
  }

  const auto& machine = job.settings.machine;
  const mesh::Plate bed{print_surface(machine), machine.bed_exclude_areas, height_of(machine)};
  auto placed = mesh::place(std::move(loaded),
                            {.stretch_xy = job.settings.material.material_shrinkage_percentage_xy / 100,
                             .stretch_z = job.settings.material.material_shrinkage_percentage_z / 100,
                             .rotate_deg = job.placement.rotate_deg,
                             .keep_position = job.placement.keep_position,
                             .drop = job.placement.drop,
                             .center = job.placement.centre,
                             .copies = job.placement.copies,
                             .spacing = job.placement.spacing},
                            bed);
  // What does not fit is told before an hour of slicing; to annotate, the audit must see it.
  if (job.audit == audit::Mode::reject) mesh::check_fits(placed, bed, job.settings.audit.audit_tolerance);

  auto object = out.objects.begin();
  for (auto& model : placed)
    for (std::size_t i = 0; i < model.objects.size(); ++i, ++object) {
      object->volumes.front().mesh = std::move(model.objects[i]);
      object->hull = std::move(model.footprints[i]);
      object->marks = std::move(model.marks[i]);
      object->copies = model.instances;
    }
  return out;
}

std::vector<gcode::Thumbnail> thumbnails_of(const Settings& settings, const Plate& plate) {
  const auto& sizes = settings.gcode.thumbnails;
  if (sizes.empty() || plate.objects.empty()) return {};
  std::vector<preview::Standing> standing;
  for (const auto& object : plate.objects)
    for (const auto& volume : object.volumes) standing.push_back({&volume.mesh, object.copies.front()});
  return tasks::parallel_map(sizes.size(), [&](std::size_t i) {
    const auto size = sizes[i];
    const auto png = preview::thumbnail(standing, {size.width, size.height});
    return gcode::Thumbnail{size.width, size.height, std::string(png.begin(), png.end())};
  });
}

}  // namespace weft::pipeline
