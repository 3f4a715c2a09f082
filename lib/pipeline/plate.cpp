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
             cache, [&] { return StageKey("read", 1).with(path).with(hash).with(scale); },
             [&] { return mesh::read(file.view(), path, {.scale = scale, .sha256 = hash}); })
      .take();
}

}  // namespace

std::vector<PlacedObject> place_models(const Job& job, Report& report, StageCache* cache) {
  const Stopwatch stopwatch(report.timings_ms.read);
  auto loaded = tasks::parallel_map(
      job.models.size(), [&](std::size_t i) { return read_model(job.models[i], job.placement.scale, cache); });
  std::vector<PlacedObject> out;
  for (const auto& model : loaded) {
    note_model(model, report);
    for (std::size_t i = 0; i < model.objects.size(); ++i) out.push_back({name_of(model, i), {}, {}, {}});
  }

  const auto& machine = job.settings.machine;
  const mesh::Plate plate{print_surface(machine), machine.bed_exclude_areas, height_of(machine)};
  auto placed = mesh::place(std::move(loaded),
                            {.stretch_xy = job.settings.material.material_shrinkage_percentage_xy / 100,
                             .stretch_z = job.settings.material.material_shrinkage_percentage_z / 100,
                             .rotate_deg = job.placement.rotate_deg,
                             .keep_position = job.placement.keep_position,
                             .drop = job.placement.drop,
                             .center = job.placement.centre,
                             .copies = job.placement.copies,
                             .spacing = job.placement.spacing},
                            plate);
  // What does not fit is told before an hour of slicing; to annotate, the audit must see it.
  if (job.audit == audit::Mode::reject) mesh::check_fits(placed, plate, job.settings.audit.audit_tolerance);

  auto object = out.begin();
  for (auto& model : placed)
    for (std::size_t i = 0; i < model.objects.size(); ++i, ++object) {
      object->mesh = std::move(model.objects[i]);
      object->hull = std::move(model.footprints[i]);
      object->offsets = model.instances;
    }
  return out;
}

std::vector<gcode::Thumbnail> thumbnails_of(const Settings& settings, const std::vector<PlacedObject>& objects) {
  const auto& sizes = settings.gcode.thumbnails;
  if (sizes.empty() || objects.empty()) return {};
  std::vector<preview::Standing> plate;
  for (const auto& object : objects) plate.push_back({&object.mesh, object.offsets.front()});
  return tasks::parallel_map(sizes.size(), [&](std::size_t i) {
    const auto size = sizes[i];
    const auto png = preview::thumbnail(plate, {size.width, size.height});
    return gcode::Thumbnail{size.width, size.height, std::string(png.begin(), png.end())};
  });
}

}  // namespace weft::pipeline
