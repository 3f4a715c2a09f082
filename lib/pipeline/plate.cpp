// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/plate.h"

#include "core/convex_hull.h"
#include "core/error.h"
#include "core/file_bytes.h"
#include "core/hash.h"
#include "geometry/offset.h"
#include "mesh/placement.h"
#include "mesh/read.h"
#include "pipeline/cached.h"
#include "pipeline/infill_files.h"
#include "pipeline/model_parts.h"
#include "pipeline/nest.h"
#include "pipeline/provenance.h"
#include "pipeline/room_around.h"
#include "pipeline/stopwatch.h"
#include "pipeline/tints.h"
#include "pipeline/transform_models.h"
#include "pipeline/transform_words.h"
#include "profile/foreign_overlay.h"
#include "settings/modifier_list.h"
#include "settings/value.h"
#include "tasks/parallel.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
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
std::string name_of(const mesh::Loaded& model, std::size_t object) {
  const auto& own = model.objects[object].name;
  return own.empty() ? stem_of(model, object, model.objects.size()) : own;
}
std::string name_of_item(const mesh::Loaded& model, std::size_t item) {
  const auto& own = model.items[item].name;
  return own.empty() ? stem_of(model, item, model.items.size()) : own;
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

/// The tool that is named behind a model's file holds for that object, or part of one.
void give_tool(std::optional<int> tool, Overlay& overlay, const std::string& typed) {
  if (tool) overlay.add("extruder_nr", std::to_string(*tool), typed);
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

/// Objects of one model that are placed together.
struct Together {
  std::size_t model = 0;
  std::vector<std::size_t> objects;  ///< of the model
  mesh::PlacementOfModel own{};
};

/// Puts what files say of objects on the plate, and makes them findable by name.
class Builder {
 public:
  Builder(const Job& job, std::vector<Typed> typed, Report& report)
      : job_(job), typed_(std::move(typed)), notices_(report.warnings) {
    for (std::size_t m = 0; m < typed_.size(); ++m) add(m);
  }

  /// What is placed: a model each, but for its objects of which something of their own is said.
  std::vector<Together> together() const {
    std::vector<Together> out;
    for (std::size_t m = 0; m < typed_.size(); ++m) {
      const auto& objects = typed_[m].model.objects;
      Together rest{m, {}, {}};
      std::map<std::size_t, Together> alone;  // by item
      for (std::size_t i = 0; i < objects.size(); ++i) {
        const std::size_t object = object_of_.at({m, objects[i].item});
        auto own = own_of(object);
        if (!own) {
          rest.objects.push_back(i);
          continue;
        }
        auto& to = alone[objects[i].item];
        to.model = m, to.own = *own;
        to.objects.push_back(i);
      }
      const auto same = [&](const auto& each) { return each.second.own == alone.begin()->second.own; };
      if (rest.objects.empty() && !alone.empty() &&
          std::all_of(alone.begin(), alone.end(), same)) {  // said of the model as a whole
        Together whole{m, {}, alone.begin()->second.own};
        for (std::size_t i = 0; i < objects.size(); ++i) whole.objects.push_back(i);
        out.push_back(std::move(whole));
        continue;
      }
      if (!rest.objects.empty()) out.push_back(std::move(rest));
      for (auto& [item, each] : alone) out.push_back(std::move(each));
    }
    return out;
  }

  /// The model's objects, for once.
  mesh::Loaded take(const Together& what) {
    auto& model = typed_[what.model].model;
    mesh::Loaded out;
    out.path = model.path;
    for (const std::size_t i : what.objects) out.objects.push_back(std::move(model.objects[i]));
    return out;
  }

  void put(const Together& what, mesh::PlacedModel placed) {
    const auto& tools = typed_[what.model].tools;
    std::map<std::size_t, std::vector<std::size_t>> parts_of;  // by object of the plate: indices into `placed`
    for (std::size_t k = 0; k < what.objects.size(); ++k)
      parts_of[object_of_.at({what.model, item_of_[what.model][what.objects[k]]})].push_back(k);
    for (const auto& [o, parts] : parts_of) {
      auto& object = plate_.objects[o];
      for (const std::size_t k : parts) {
        auto& volume = object.volumes[volume_of_[what.model][what.objects[k]]];
        volume.mesh = std::move(placed.objects[k]);
        give_tool(tools[what.objects[k]], typed_[what.model].one_object ? volume.overlay : object.overlay,
                  typed_[what.model].model.path);
        for (auto& mark : placed.marks[k]) add_mark(std::move(mark), typed_[what.model].model.path, object);
      }
      in_order(object);
      object.hull = parts.size() == placed.footprints.size() ? placed.hull : hull_of(placed, parts);
      object.copies = placed.instances;
      object.turned_deg = job_.placement.rotate_deg + what.own.rotate_deg;
    }
  }

  Plate take_plate() && {
    plate::lay_by_name(job_.by_name, plate_, origins_);
    return std::move(plate_);
  }

 private:
  void add(std::size_t m) {
    const auto& model = typed_[m].model;
    for (const auto& object : model.objects) {
      const auto [at, is_new] = object_of_.try_emplace({m, object.item}, plate_.objects.size());
      if (is_new) {
        plate_.objects.push_back({name_of_item(model, object.item), {}});
        auto& added = plate_.objects.back();
        added.overlay = {fmt::format("object '{}'", added.name), Scope::object};
        const auto& item = model.items[object.item];
        lay(model, item.settings, added.overlay);
        added.heights = item.heights;
        for (const auto& range : item.ranges) {
          added.ranges.push_back(
              {range.from,
               range.to,
               {fmt::format("object '{}', {} … {} mm", added.name, to_mm(range.from), to_mm(range.to)), Scope::layer}});
          lay(model, range.settings, added.ranges.back().overlay);
        }
        origins_.typed.push_back(model.path);
        origins_.model.push_back(number_of(m));
      }
      auto& to = plate_.objects[at->second];
      Volume part{.name = object.name.empty() ? to.name : object.name, .mesh = {}};
      part.overlay = {fmt::format("part '{}'", part.name), Scope::region};
      lay(model, object.settings, part.overlay);
      item_of_[m].push_back(object.item);
      volume_of_[m].push_back(to.volumes.size());
      to.volumes.push_back(std::move(part));
    }
  }

  void lay_words(mesh::Author author, const std::vector<mesh::ForeignSetting>& said, const std::string& path,
                 Overlay& to) {
    ForeignSettings foreign;
    foreign.dialect = author == mesh::Author::cura   ? Dialect::cura
                      : author == mesh::Author::orca ? Dialect::orca
                                                     : Dialect::prusaslicer;
    for (const auto& [key, value] : said) foreign.values.emplace_back(key, value);
    lay_foreign(foreign, job_.settings, std::filesystem::path(path).filename().string(), to, notices_);
  }
  void lay(const mesh::Loaded& model, const std::vector<mesh::ForeignSetting>& said, Overlay& to) {
    const auto file = std::filesystem::path(model.path).filename().string();
    if (!said.empty()) lay_words(model.author, with_extruders(said, job_.settings, file, notices_), model.path, to);
  }

  /// Its place among the models of the job; what comes of a cut or a split is of the model that it comes of.
  std::size_t number_of(std::size_t m) const {
    if (typed_.size() == job_.models.size()) return m;
    const auto at = std::find(job_.models.begin(), job_.models.end(), typed_[m].model.path);
    return at == job_.models.end() ? 0 : static_cast<std::size_t>(at - job_.models.begin());
  }

  /// What is said of where an object stands, and how often.
  std::optional<mesh::PlacementOfModel> own_of(std::size_t object) const {
    std::optional<mesh::PlacementOfModel> out;
    for (const auto& place : job_.by_name.places)
      if (plate::means(place.of, plate_, origins_, object)) {
        if (!out) out.emplace();
        out->at = place.at, out->rotate_deg = place.rotate_deg, out->copies = 1;
      }
    for (const auto& copies : job_.by_name.copies)
      if (plate::means(copies.of, plate_, origins_, object)) {
        if (!out) out.emplace();
        if (out->at && copies.count > 1)
          throw Error{Error::Kind::usage,
                      fmt::format("'{}' is to stand in one place, {} times", plate_.objects[object].name, copies.count),
                      "--place", "leave out --copies of it, or its --place"};
        out->copies = copies.count;
      }
    return out;
  }

  void add_tint(mesh::Mark mark, const std::string& path, Object& object) {
    const auto file = std::filesystem::path(path).filename().string();
    auto tint = tint_of(std::move(mark), object, job_.settings, file, notices_);
    if (!tint) return;
    for (auto& [after, volume] : later_[&object])
      if (volume.kind == VolumeKind::tint && volume.name == tint->name) return join(volume, std::move(tint->mesh));
    later_[&object].push_back({mark.after, std::move(*tint)});
  }

  void add_mark(mesh::Mark mark, const std::string& path, Object& object) {
    if (mark.kind == mesh::MarkKind::tint) return add_tint(std::move(mark), path, object);
    if (mark.kind != mesh::MarkKind::modifier && mark.kind != mesh::MarkKind::negative) {
      object.marks.push_back(std::move(mark));
      return;
    }
    const bool modifies = mark.kind == mesh::MarkKind::modifier;
    Volume volume{.name = mark.name,
                  .mesh = std::move(mark.mesh),
                  .kind = modifies ? VolumeKind::modifier : VolumeKind::negative};
    volume.overlay = {fmt::format("modifier '{}'", volume.name), Scope::region};
    if (mark.author == mesh::Author::unknown)
      for (const auto& [key, text] : mark.settings) volume.overlay.add(key, text, "--modifier " + volume.name);
    else
      lay_words(mark.author, mark.settings, path, volume.overlay);
    later_[&object].push_back({mark.after, std::move(volume)});
  }

  /// Negative volumes behind the parts that they cut, modifiers behind them all, and paint behind those.
  void in_order(Object& object) {
    auto& later = later_[&object];
    std::vector<Volume> out;
    std::size_t part = 0;
    const auto negatives_after = [&](std::size_t from, std::size_t to) {
      for (auto& [after, volume] : later)
        if (volume.kind == VolumeKind::negative && after >= from && after < to) out.push_back(std::move(volume));
    };
    for (auto& volume : object.volumes) {
      out.push_back(std::move(volume));
      ++part;
      if (part < object.volumes.size()) negatives_after(part, part + 1);
    }
    negatives_after(part, ~std::size_t{0});
    for (auto& [after, volume] : later)
      if (volume.kind == VolumeKind::negative && after == ~std::size_t{0}) out.push_back(std::move(volume));
    for (const auto kind : {VolumeKind::modifier, VolumeKind::tint})
      for (auto& [after, volume] : later)
        if (volume.kind == kind) out.push_back(std::move(volume));
    object.volumes = std::move(out);
    later_.erase(&object);
  }

  static Ring hull_of(const mesh::PlacedModel& placed, const std::vector<std::size_t>& parts) {
    if (parts.size() == 1) return placed.footprints[parts.front()];
    std::vector<Point> corners;
    for (const std::size_t k : parts)
      corners.insert(corners.end(), placed.footprints[k].begin(), placed.footprints[k].end());
    return convex_hull(std::move(corners));
  }

  struct Later {
    std::size_t after;
    Volume volume;
  };
  const Job& job_;
  std::vector<Typed> typed_;
  Notices& notices_;
  Plate plate_;
  plate::Origins origins_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> object_of_;  ///< of the plate, by model and item
  std::map<std::size_t, std::vector<std::size_t>> item_of_, volume_of_;   ///< of each object of a model
  std::map<const Object*, std::vector<Later>> later_;
};

/// Places by true outlines. @throws Error{audit} where not all fit, and are not as many as fit
std::vector<std::vector<Point>> nested(const Job& job, std::span<const mesh::ToPlace> models, const mesh::Plate& free) {
  const bool fill = job.placement.fill;
  std::vector<NestKind> kinds;
  for (const auto& model : models)
    kinds.push_back({silhouette_of(model.model->objects), fill && model.copies == 1 ? 0 : model.copies});
  const Um skirt = skirt_of(job.settings);
  const auto within = skirt > 0 ? geometry::offset({{free.surface, {}}}, {.by = -skirt}) : Regions{};
  NestBed bed{within.empty() ? free.surface : within.front().outer, free.keep_out,
              job.placement.centre.value_or(weft::box_of(free.surface).centre()),
              std::max(job.placement.spacing, head_of(job.settings)), brim_of(job.settings)};
  auto out = nest(kinds, bed);
  for (std::size_t k = 0; k < models.size(); ++k)
    if (out[k].size() < std::max<std::size_t>(kinds[k].copies, 1))
      throw Error{
          Error::Kind::audit,
          kinds[k].copies == 0 ? "there is no room for it"
                               : fmt::format("there is room for {} of {} copies of it", out[k].size(), kinds[k].copies),
          models[k].model->path, "print fewer, or with less --spacing; --fill prints as many as there is room for"};
  return out;
}

}  // namespace

Plate place_models(const Job& job, Report& report, StageCache* cache) {
  const Stopwatch stopwatch(report.timings_ms[Stage::read]);
  const auto& transform = job.placement.transform;
  const bool turned = transforms(transform);
  const mesh::ReadOptions read{
      .scale = job.placement.scale, .mm_per_unit = transform.mm_per_unit, .sha256 = {}, .plate = job.placement.plate};
  auto typed =
      tasks::parallel_map(job.models.size(), [&](std::size_t i) { return read_typed(job.models[i], read, cache); });
  const auto marks = marks_of(job);
  add_marks(marks, marks.size() - job.marks.size(), read, typed, report);
  report.infill_files = infill_files(job.settings.infill);
  for (const auto& each : typed) note_model(each.model, report);
  if (turned || transform.mm_per_unit != 1)
    for (auto& model : report.models) tell_transforms(job.placement, model);
  if (turned) typed = transformed(job.settings, job.placement, std::move(typed), report.models);
  Builder builder(job, std::move(typed), report);
  auto together = builder.together();
  mesh::PlacementOptions options{.stretch_xy = job.settings.material.material_shrinkage_percentage_xy / 100,
                                 .stretch_z = job.settings.material.material_shrinkage_percentage_z / 100,
                                 .rotate_deg = turned ? 0 : job.placement.rotate_deg,
                                 .keep_position = job.placement.keep_position,
                                 .drop = job.placement.drop,
                                 .center = job.placement.centre,
                                 .copies = job.placement.copies,
                                 .spacing = job.placement.spacing};
  if (job.placement.arrange || job.placement.fill)
    options.arranger = [&](std::span<const mesh::ToPlace> models, const mesh::Plate& free) {
      return nested(job, models, free);
    };
  std::vector<mesh::Loaded> taken;
  for (const auto& each : together) {
    taken.push_back(builder.take(each));
    options.of_model.push_back(each.own);
  }
  const auto& machine = job.settings.machine;
  const mesh::Plate bed{print_surface(machine), machine.bed_exclude_areas, height_of(machine)};
  auto placed = mesh::place(std::move(taken), options, bed);
  // What does not fit is told before an hour of slicing; to annotate, the audit must see it.
  if (job.audit == audit::Mode::reject) mesh::check_fits(placed, bed, job.settings.audit.audit_tolerance);
  for (std::size_t i = 0; i < placed.size(); ++i) builder.put(together[i], std::move(placed[i]));
  return std::move(builder).take_plate();
}

}  // namespace weft::pipeline
