// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/read_models.h"

#include "core/error.h"
#include "core/file_bytes.h"
#include "core/hash.h"
#include "mesh/read.h"
#include "pipeline/cached.h"
#include "pipeline/infill_files.h"
#include "pipeline/model_parts.h"
#include "pipeline/provenance.h"
#include "settings/modifier_list.h"
#include "settings/value.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

std::string stem_of(const mesh::Loaded& model, std::size_t number, std::size_t count) {
  const auto stem = std::filesystem::path(model.path).stem().string();
  return count == 1 ? stem : fmt::format("{}_{}", stem, number + 1);
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
               return StageKey(row_of<Stage::read>())
                   .with(path)
                   .with(hash)
                   .with(read.scale)
                   .with(read.mm_per_unit)
                   .with(Um{read.plate});
             },
             [&] {
               auto options = read;
               options.sha256 = hash;
               return mesh::read(file.view(), path, options);
             })
      .take();
}

Typed read_typed(const std::string& typed, const mesh::ReadOptions& read, StageCache* cache) {
  const auto parts = parts_of(typed);
  Typed out;
  out.one_object = parts.size() > 1;
  for (const auto& part : parts) {
    auto model = read_model(part.file, read, cache);
    if (out.one_object)
      for (auto& object : model.objects) {
        object.item = 0;
        if (object.name.empty()) object.name = std::filesystem::path(part.file).stem().string();
      }
    out.tools.insert(out.tools.end(), model.objects.size(), part.tool);
    if (out.tools.size() == model.objects.size()) {
      if (out.one_object) model.items.resize(1), model.items.front().name = model.objects.front().name;
      out.model = std::move(model);
      continue;
    }
    auto& all = out.model;
    all.sha256 = sha256(all.sha256 + model.sha256);
    all.triangles_in_file += model.triangles_in_file;
    std::move(model.objects.begin(), model.objects.end(), std::back_inserter(all.objects));
    std::move(model.notices.begin(), model.notices.end(), std::back_inserter(all.notices));
  }
  out.model.path = typed;
  return out;
}

/// The eight corners and twelve triangles of a box. @throws Error{usage}
Mesh box_mesh(const std::string& source, double scale, const std::string& option) {
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
    throw Error{Error::Kind::usage, fmt::format("'{}' is not six numbers of mm", source), option,
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

/// The option that a mark is named with.
std::string option_of(mesh::MarkKind kind) {
  std::string out = "--" + std::string(mark_key(kind));
  std::replace(out.begin(), out.end(), '_', '-');
  return out;
}

/// What the command line or a job marks, and before that what infill_modifiers lays beside each model.
std::vector<ModelMark> marks_of(const Job& job) {
  std::vector<ModelMark> out;
  for (const auto& mesh : parse_modifier_list(job.settings.infill.infill_modifiers))
    for (std::size_t m = 0; m < job.models.size(); ++m) {
      ModelMark mark{m, mesh::MarkKind::modifier, mesh.file, {{"infill_sparse_density", mesh.density_percent}}};
      if (!mesh.pattern.empty()) mark.settings.emplace_back("infill_pattern", mesh.pattern);
      out.push_back(std::move(mark));
    }
  out.insert(out.end(), job.marks.begin(), job.marks.end());
  return out;
}

/// They are laid beside each object that is printed of the model. @param first  those of infill_modifiers, which the
/// settings tell of
void add_marks(const std::vector<ModelMark>& marks, std::size_t first, const mesh::ReadOptions& read,
               std::vector<Typed>& typed, Report& report) {
  for (std::size_t i = 0; i < marks.size(); ++i) {
    const auto& mark = marks[i];
    std::vector<Mesh> meshes;
    Report::Mark told{mark.model, std::string(mark_key(mark.kind)), mark.source, {}, mark.settings};
    if (mark.source.starts_with("box:")) {
      meshes.push_back(box_mesh(mark.source, read.scale * read.mm_per_unit, option_of(mark.kind)));
    } else {
      auto file = mesh::read_file(mark.source, {.scale = read.scale, .mm_per_unit = read.mm_per_unit});
      told.sha256 = file.sha256;
      for (auto& object : file.objects) meshes.push_back(std::move(object.mesh));
    }
    if (i >= first) report.marks.push_back(std::move(told));
    const bool is_box = mark.source.starts_with("box:");
    mesh::Mark out{mark.kind, false, {}, is_box ? mark.source : std::filesystem::path(mark.source).stem().string()};
    for (const auto& [key, text] : mark.settings) out.settings.push_back({key, text});
    std::set<std::size_t> items;
    for (auto& object : typed[mark.model].model.objects)
      if (items.insert(object.item).second)
        for (const Mesh& mesh : meshes) out.mesh = mesh, object.marks.push_back(out);
  }
}

}  // namespace

std::string name_of(const mesh::Loaded& model, std::size_t object) {
  const auto& own = model.objects[object].name;
  return own.empty() ? stem_of(model, object, model.objects.size()) : own;
}
std::string name_of_item(const mesh::Loaded& model, std::size_t item) {
  const auto& own = model.items[item].name;
  return own.empty() ? stem_of(model, item, model.items.size()) : own;
}

mesh::ReadOptions read_options_of(const Job& job) {
  return {.scale = job.placement.scale,
          .mm_per_unit = job.placement.transform.mm_per_unit,
          .sha256 = {},
          .plate = job.placement.plate};
}

std::vector<Typed> read_models(const Job& job, Report& report, StageCache* cache) {
  const auto read = read_options_of(job);
  auto typed =
      tasks::parallel_map(job.models.size(), [&](std::size_t i) { return read_typed(job.models[i], read, cache); });
  const auto marks = marks_of(job);
  add_marks(marks, marks.size() - job.marks.size(), read, typed, report);
  report.infill_files = infill_files(job.settings.infill);
  for (const auto& each : typed) note_model(each.model, report);
  return typed;
}

}  // namespace weft::pipeline
