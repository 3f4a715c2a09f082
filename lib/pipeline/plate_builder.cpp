// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/plate_builder.h"

#include "core/convex_hull.h"
#include "core/error.h"
#include "pipeline/read_models.h"
#include "pipeline/tints.h"
#include "profile/foreign_overlay.h"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

/// The tool that is named behind a model's file holds for that object, or part of one.
void give_tool(std::optional<int> tool, Overlay& overlay, const std::string& typed) {
  if (tool) overlay.add("extruder_nr", std::to_string(*tool), typed);
}

Ring hull_of(const mesh::PlacedModel& placed, const std::vector<std::size_t>& parts) {
  if (parts.size() == placed.footprints.size()) return placed.hull;
  if (parts.size() == 1) return placed.footprints[parts.front()];
  std::vector<Point> corners;
  for (const std::size_t k : parts)
    corners.insert(corners.end(), placed.footprints[k].begin(), placed.footprints[k].end());
  return convex_hull(std::move(corners));
}

/// Negative volumes behind the parts that they cut, modifiers behind them all, and paint behind those.
void put_in_order(std::vector<Later> later, Object& object) {
  std::vector<Volume> out;
  const auto negatives = [&](auto wanted) {
    for (auto& [after, volume] : later)
      if (volume.kind == VolumeKind::negative && wanted(after)) out.push_back(std::move(volume));
  };
  std::size_t part = 0;
  for (auto& volume : object.volumes) {
    out.push_back(std::move(volume));
    if (++part < object.volumes.size()) negatives([&](std::size_t after) { return after == part; });
  }
  negatives([&](std::size_t after) { return after >= part && after != all_before; });
  negatives([](std::size_t after) { return after == all_before; });
  for (const auto kind : {VolumeKind::modifier, VolumeKind::tint})
    for (auto& [after, volume] : later)
      if (volume.kind == kind) out.push_back(std::move(volume));
  object.volumes = std::move(out);
}

}  // namespace

PlateBuilder::PlateBuilder(const Job& job, std::vector<Typed>& models, Report& report)
    : job_(job), typed_(models), notices_(report.warnings) {
  for (std::size_t m = 0; m < typed_.size(); ++m) add(m);
}

void PlateBuilder::add(std::size_t m) {
  const auto& model = typed_[m].model;
  for (const auto& object : model.objects) {
    const auto [at, is_new] = object_of_.try_emplace({m, object.item}, all_.objects.size());
    if (is_new) {
      all_.objects.push_back({name_of_item(model, object.item), {}});
      auto& added = all_.objects.back();
      added.copies.clear();
      added.overlay = {fmt::format("object '{}'", added.name), Scope::object};
      const auto& item = model.items[object.item];
      lay(model, item.settings, added.overlay);
      for (const auto& range : item.ranges) {
        added.ranges.push_back(
            {range.from,
             range.to,
             {fmt::format("object '{}', {} … {} mm", added.name, to_mm(range.from), to_mm(range.to)), Scope::layer}});
        lay(model, range.settings, added.ranges.back().overlay);
      }
      added.heights = item.heights;
      origins_.typed.push_back(model.path);
      origins_.model.push_back(number_of(m));
    }
    auto& to = all_.objects[at->second];
    Volume part{.name = object.name.empty() ? to.name : object.name, .mesh = {}};
    part.overlay = {fmt::format("part '{}'", part.name), Scope::region};
    lay(model, object.settings, part.overlay);
    item_of_[m].push_back(object.item);
    volume_of_[m].push_back(to.volumes.size());
    to.volumes.push_back(std::move(part));
  }
}

void PlateBuilder::lay_words(mesh::Author author, const std::vector<mesh::ForeignSetting>& said,
                             const std::string& path, Overlay& to) {
  ForeignSettings foreign;
  foreign.dialect = author == mesh::Author::cura   ? Dialect::cura
                    : author == mesh::Author::orca ? Dialect::orca
                                                   : Dialect::prusaslicer;
  for (const auto& [key, value] : said) foreign.values.emplace_back(key, value);
  lay_foreign(foreign, job_.settings, std::filesystem::path(path).filename().string(), to, notices_);
}

void PlateBuilder::lay(const mesh::Loaded& model, const std::vector<mesh::ForeignSetting>& said, Overlay& to) {
  const auto file = std::filesystem::path(model.path).filename().string();
  if (!said.empty()) lay_words(model.author, with_extruders(said, job_.settings, file, notices_), model.path, to);
}

/// Its place among the models of the job; what comes of a cut or a split is of the model that it comes of.
std::size_t PlateBuilder::number_of(std::size_t m) const {
  if (typed_.size() == job_.models.size()) return m;
  const auto at = std::find(job_.models.begin(), job_.models.end(), typed_[m].model.path);
  return at == job_.models.end() ? 0 : static_cast<std::size_t>(at - job_.models.begin());
}

/// What is said of where an object stands, and how often.
std::optional<mesh::PlacementOfModel> PlateBuilder::own_of(std::size_t object) const {
  std::optional<mesh::PlacementOfModel> out;
  const auto own = [&]() -> mesh::PlacementOfModel& { return out ? *out : out.emplace(); };
  for (const auto& place : job_.by_name.places)
    if (plate::means(place.of, all_, origins_, object)) own().at.push_back({place.at, place.rotate_deg});
  for (const auto& copies : job_.by_name.copies)
    if (plate::means(copies.of, all_, origins_, object)) {
      if (out && !out->at.empty() && static_cast<std::size_t>(copies.count) != out->at.size())
        throw Error{Error::Kind::usage,
                    fmt::format("'{}' is to stand in {} place{}, {} times", all_.objects[object].name, out->at.size(),
                                out->at.size() == 1 ? "" : "s", copies.count),
                    "--place", "leave out --copies of it, or say --place once a copy"};
      own().copies = copies.count;
    }
  return out;
}

std::vector<Together> PlateBuilder::together() const {
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

mesh::Loaded PlateBuilder::take(const Together& what) {
  auto& model = typed_[what.model].model;
  mesh::Loaded out;
  out.path = model.path;
  for (const std::size_t i : what.objects) out.objects.push_back(std::move(model.objects[i]));
  return out;
}

Volume PlateBuilder::volume_of(mesh::Mark mark, const std::string& path) {
  const bool modifies = mark.kind == mesh::MarkKind::modifier;
  Volume volume{
      .name = mark.name, .mesh = std::move(mark.mesh), .kind = modifies ? VolumeKind::modifier : VolumeKind::negative};
  volume.overlay = {fmt::format("modifier '{}'", volume.name), Scope::region};
  if (mark.author == mesh::Author::unknown)
    for (const auto& [key, text] : mark.settings) volume.overlay.add(key, text, "--modifier " + volume.name);
  else
    lay_words(mark.author, mark.settings, path, volume.overlay);
  return volume;
}

void PlateBuilder::add_tint(mesh::Mark mark, const std::string& path, const Object& object, std::vector<Later>& to) {
  const std::size_t after = mark.after;
  auto tint =
      tint_of(std::move(mark), object, job_.settings, std::filesystem::path(path).filename().string(), notices_);
  if (!tint) return;
  for (auto& [at, volume] : to)
    if (volume.kind == VolumeKind::tint && volume.name == tint->name) return join(volume, std::move(tint->mesh));
  to.push_back({after, *std::move(tint)});
}

void PlateBuilder::put(const Together& what, mesh::PlacedModel placed) {
  const auto& tools = typed_[what.model].tools;
  const auto& path = typed_[what.model].model.path;
  std::map<std::size_t, std::vector<std::size_t>> parts_of;  // by object: indices into `placed`
  for (std::size_t k = 0; k < what.objects.size(); ++k)
    parts_of[object_of_.at({what.model, item_of_[what.model][what.objects[k]]})].push_back(k);
  for (const auto& [o, parts] : parts_of) {
    Object object = all_.objects[o];
    std::vector<Later> later;
    for (const std::size_t k : parts) {
      auto& volume = object.volumes[volume_of_[what.model][what.objects[k]]];
      volume.mesh = std::move(placed.objects[k]);
      give_tool(tools[what.objects[k]], typed_[what.model].one_object ? volume.overlay : object.overlay, path);
      for (auto& mark : placed.marks[k])
        if (mark.kind == mesh::MarkKind::tint) {
          add_tint(std::move(mark), path, object, later);
        } else if (mark.kind != mesh::MarkKind::modifier && mark.kind != mesh::MarkKind::negative) {
          object.marks.push_back(std::move(mark));
        } else {
          const std::size_t after = mark.after;
          later.push_back({after, volume_of(std::move(mark), path)});
        }
    }
    put_in_order(std::move(later), object);
    object.hull = hull_of(placed, parts);
    object.copies = placed.instances;
    object.turned_deg = job_.placement.rotate_deg + placed.turned_deg;
    put_.emplace_back(o, std::move(object));
  }
}

namespace {

/// Is `b` what `a` is, moved by whole microns along the bed? @return by how much
std::optional<Point> moved_by(const Mesh& a, const Mesh& b) {
  if (a.triangles != b.triangles || a.vertices.size() != b.vertices.size() || a.vertices.empty() ||
      a.cut_through != b.cut_through)
    return std::nullopt;
  const Point by = flat(b.vertices.front()) - flat(a.vertices.front());
  for (std::size_t i = 0; i < a.vertices.size(); ++i)
    if (flat(b.vertices[i]) - flat(a.vertices[i]) != by || a.vertices[i].z != b.vertices[i].z) return std::nullopt;
  return by;
}

bool equal(const Overlay& a, const Overlay& b) {
  return std::equal(a.values.begin(), a.values.end(), b.values.begin(), b.values.end(),
                    [](const Laid& x, const Laid& y) { return x.row == y.row && x.origin.text == y.origin.text; });
}

bool equal(const std::vector<HeightRange>& a, const std::vector<HeightRange>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const HeightRange& x, const HeightRange& y) {
    return x.from == y.from && x.to == y.to && equal(x.overlay, y.overlay);
  });
}

/// Is one a copy of the other? @return how far away
std::optional<Point> copy_by(const Object& a, const Object& b) {
  if (a.name != b.name || a.volumes.size() != b.volumes.size() || a.marks.size() != b.marks.size() ||
      a.heights != b.heights || a.turned_deg != b.turned_deg || !equal(a.overlay, b.overlay) ||
      !equal(a.said, b.said) || !equal(a.ranges, b.ranges))
    return std::nullopt;
  std::optional<Point> out;
  const auto agrees = [&](const Mesh& x, const Mesh& y) {
    const auto by = moved_by(x, y);
    if (by && !out) out = by;
    return by && *by == *out;
  };
  for (std::size_t v = 0; v < a.volumes.size(); ++v) {
    const auto &x = a.volumes[v], &y = b.volumes[v];
    if (x.kind != y.kind || x.name != y.name || !equal(x.overlay, y.overlay) || !equal(x.said, y.said) ||
        !agrees(x.mesh, y.mesh))
      return std::nullopt;
  }
  for (std::size_t m = 0; m < a.marks.size(); ++m)
    if (a.marks[m].kind != b.marks[m].kind || a.marks[m].painted != b.marks[m].painted ||
        !agrees(a.marks[m].mesh, b.marks[m].mesh))
      return std::nullopt;
  return out;
}

/// What follows its like is a copy of it, and sliced with it.
void join_copies(std::vector<Object>& objects) {
  std::vector<Object> out;
  for (auto& object : objects) {
    const auto by = out.empty() ? std::nullopt : copy_by(out.back(), object);
    if (!by) {
      out.push_back(std::move(object));
      continue;
    }
    for (const Point at : object.copies) out.back().copies.push_back(at + *by);
  }
  objects = std::move(out);
}

}  // namespace

Plate PlateBuilder::plate() && {
  std::stable_sort(put_.begin(), put_.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  Plate out;
  plate::Origins origins;
  for (auto& [o, object] : put_) {
    out.objects.push_back(std::move(object));
    origins.typed.push_back(origins_.typed[o]);
    origins.model.push_back(origins_.model[o]);
  }
  plate::lay_by_name(job_.by_name, out, origins);
  std::erase_if(out.objects, [](const Object& object) { return object.copies.empty(); });
  join_copies(out.objects);
  return out;
}

}  // namespace weft::pipeline
