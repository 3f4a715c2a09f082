// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/plate.h"

#include "core/error.h"
#include "core/file_bytes.h"
#include "core/hash.h"
#include "mesh/placement.h"
#include "mesh/read.h"
#include "pipeline/cached.h"
#include "pipeline/model_parts.h"
#include "pipeline/provenance.h"
#include "pipeline/stopwatch.h"
#include "pipeline/transform_models.h"
#include "pipeline/transform_words.h"
#include "preview/thumbnail.h"
#include "settings/value.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <stdexcept>

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
mesh::Loaded read_model(const std::string& path, const mesh::ReadOptions& read, StageCache* cache) {
  if (!cache) return mesh::read_file(path, read);
  const FileBytes file(path);
  const auto hash = sha256(file.view());
  return cached(
             cache,
             [&] {
               return StageKey(row_of<Stage::read>()).with(path).with(hash).with(read.scale).with(read.mm_per_unit);
             },
             [&] {
               return mesh::read(file.view(), path,
                                 {.scale = read.scale, .mm_per_unit = read.mm_per_unit, .sha256 = hash});
             })
      .take();
}

Typed read_typed(const std::string& typed, const mesh::ReadOptions& read, StageCache* cache) {
  const auto parts = parts_of(typed);
  Typed out;
  for (const auto& part : parts) {
    auto model = read_model(part.file, read, cache);
    out.tools.insert(out.tools.end(), model.objects.size(), part.tool);
    if (out.tools.size() == model.objects.size()) {
      out.model = std::move(model);
      continue;
    }
    out.one_object = true;
    auto& all = out.model;
    all.sha256 = sha256(all.sha256 + model.sha256);
    all.triangles_in_file += model.triangles_in_file;
    std::move(model.objects.begin(), model.objects.end(), std::back_inserter(all.objects));
    std::move(model.notices.begin(), model.notices.end(), std::back_inserter(all.notices));
  }
  out.one_object = out.one_object || parts.size() > 1;
  out.model.path = typed;
  return out;
}

/// The tool that is named behind a model's file holds for that object, or part of one.
void give_tool(std::optional<int> tool, Overlay& overlay, const std::string& what, Scope scope,
               const std::string& typed) {
  if (!tool) return;
  overlay.what = what, overlay.scope = scope;
  overlay.add("extruder_nr", std::to_string(*tool), typed);
}

/// The eight corners and twelve triangles of a box. @throws Error{usage}
Mesh box_mesh(const std::string& source, double scale) {
  std::vector<double> at;
  std::string_view rest = std::string_view(source).substr(4);
  try {
    while (!rest.empty()) {
      const auto end = std::min(rest.find(','), rest.size());
      value::parse(rest.substr(0, end), Unit::none, at.emplace_back());
      rest.remove_prefix(std::min(end + 1, rest.size()));
    }
  } catch (const std::invalid_argument&) {
    at.clear();
  }
  const auto beyond = [](double v) { return !(std::abs(v) <= 16000); };
  for (double& v : at) v *= scale;
  if (at.size() != 6 || std::any_of(at.begin(), at.end(), beyond))
    throw Error{Error::Kind::usage, fmt::format("'{}' is not six numbers of mm", source), "--support-enforcer",
                "as in box:0,0,0,10,10,5: two opposite corners"};
  Mesh out;
  for (std::size_t i = 0; i < 8; ++i) {
    const auto pick = [&](std::size_t axis, bool high) {
      return from_mm(high ? std::max(at[axis], at[axis + 3]) : std::min(at[axis], at[axis + 3]));
    };
    out.vertices.push_back({pick(0, (i & 1) != 0), pick(1, (i & 2) != 0), pick(2, (i & 4) != 0)});
  }
  out.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return out;
}

/// What the command line or a job lays beside a model.
void add_marks(const Job& job, const mesh::ReadOptions& read, std::vector<Typed>& typed, Report& report) {
  for (const auto& mark : job.marks) {
    std::vector<Mesh> meshes;
    Report::Mark told{mark.model, std::string(mark_key(mark.kind)), mark.source, {}};
    if (mark.source.starts_with("box:")) {
      meshes.push_back(box_mesh(mark.source, read.scale * read.mm_per_unit));
    } else {
      auto file = mesh::read_file(mark.source, read);
      told.sha256 = file.sha256;
      for (auto& object : file.objects) meshes.push_back(std::move(object.mesh));
    }
    report.marks.push_back(std::move(told));
    for (auto& object : typed[mark.model].model.objects)
      for (const Mesh& mesh : meshes) object.marks.push_back({mark.kind, false, mesh});
  }
}

/// What is to be printed, with the tools that it is printed with, and without meshes.
Plate plate_of(const std::vector<mesh::Loaded>& loaded, const std::vector<Typed>& typed) {
  Plate out;
  for (std::size_t m = 0; m < loaded.size(); ++m) {
    const auto& model = loaded[m];
    const auto& [moved, tools, one_object] = typed[m];
    if (one_object) out.objects.push_back({name_of(model, 0), std::vector<Volume>(model.objects.size())});
    for (std::size_t i = 0; i < model.objects.size(); ++i) {
      const auto name = name_of(model, i);
      if (!one_object) out.objects.push_back({name, {Volume{}}});
      auto& object = out.objects.back();
      const auto what = fmt::format("{} '{}'", one_object ? "part" : "object", name);
      give_tool(tools[i], one_object ? object.volumes[i].overlay : object.overlay, what,
                one_object ? Scope::region : Scope::object, model.path);
    }
  }
  return out;
}

}  // namespace

Plate place_models(const Job& job, Report& report, StageCache* cache) {
  const Stopwatch stopwatch(report.timings_ms[Stage::read]);
  const auto& transform = job.placement.transform;
  const bool turned = transforms(transform);
  const mesh::ReadOptions read{.scale = job.placement.scale, .mm_per_unit = transform.mm_per_unit};
  auto typed =
      tasks::parallel_map(job.models.size(), [&](std::size_t i) { return read_typed(job.models[i], read, cache); });
  add_marks(job, read, typed, report);
  for (const auto& each : typed) note_model(each.model, report);
  if (turned || transform.mm_per_unit != 1)
    for (auto& model : report.models) tell_transforms(job.placement, model);
  if (turned) typed = transformed(job.settings, job.placement, std::move(typed), report.models);
  std::vector<mesh::Loaded> loaded;
  for (auto& each : typed) loaded.push_back(std::move(each.model));
  Plate out = plate_of(loaded, typed);

  const auto& machine = job.settings.machine;
  const mesh::Plate bed{print_surface(machine), machine.bed_exclude_areas, height_of(machine)};
  auto placed = mesh::place(std::move(loaded),
                            {.stretch_xy = job.settings.material.material_shrinkage_percentage_xy / 100,
                             .stretch_z = job.settings.material.material_shrinkage_percentage_z / 100,
                             .rotate_deg = turned ? 0 : job.placement.rotate_deg,
                             .keep_position = job.placement.keep_position,
                             .drop = job.placement.drop,
                             .center = job.placement.centre,
                             .copies = job.placement.copies,
                             .spacing = job.placement.spacing},
                            bed);
  // What does not fit is told before an hour of slicing; to annotate, the audit must see it.
  if (job.audit == audit::Mode::reject) mesh::check_fits(placed, bed, job.settings.audit.audit_tolerance);

  auto object = out.objects.begin();
  for (std::size_t m = 0; m < placed.size(); ++m) {
    auto& model = placed[m];
    if (typed[m].one_object) {
      for (std::size_t i = 0; i < model.objects.size(); ++i) {
        object->volumes[i].mesh = std::move(model.objects[i]);
        std::move(model.marks[i].begin(), model.marks[i].end(), std::back_inserter(object->marks));
      }
      object->hull = std::move(model.hull);
      object->copies = model.instances;
      ++object;
      continue;
    }
    for (std::size_t i = 0; i < model.objects.size(); ++i, ++object) {
      object->volumes.front().mesh = std::move(model.objects[i]);
      object->hull = std::move(model.footprints[i]);
      object->marks = std::move(model.marks[i]);
      object->copies = model.instances;
    }
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
