// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/transform_models.h"

#include "core/error.h"
#include "mesh/transform.h"
#include "pipeline/orient_model.h"
#include "pipeline/transform_words.h"

#include <algorithm>
#include <filesystem>
#include <iterator>

#include <fmt/format.h>

namespace weft::pipeline {
namespace {

/// Every mesh of a model: its objects, and what marks them.
template <class F>
void each_mesh(mesh::Loaded& model, F f) {
  for (auto& object : model.objects) {
    f(object.mesh);
    for (auto& mark : object.marks) f(mark.mesh);
  }
}

Box3 box_of_model(const mesh::Loaded& model) {
  Box3 out;
  for (const auto& object : model.objects) out.add(box_of(object.mesh));
  return out;
}

/// All that is printed of it as one mesh, where another map has turned it.
Mesh whole(const mesh::Loaded& model, const mesh::Linear& map, Point3 about) {
  Mesh out;
  for (const auto& object : model.objects) {
    const Mesh turned = mesh::transformed(object.mesh, map, about);
    const auto first = static_cast<std::uint32_t>(out.vertices.size());
    out.vertices.insert(out.vertices.end(), turned.vertices.begin(), turned.vertices.end());
    for (const Triangle& t : turned.triangles) out.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    out.cut_through = out.cut_through || turned.cut_through;
  }
  return out;
}

std::string told_orientation(const std::array<double, 3>& down) {
  return fmt::format("laid with {:.4f},{:.4f},{:.4f} down", down[0], down[1], down[2]);
}

/// The map of a model about a point.
mesh::Linear map_of(const Settings& settings, const Placement& p, const mesh::Loaded& model, Point3 about,
                    Report::Model& told) {
  const auto& t = p.transform;
  auto factors = t.stretch;
  for (std::size_t i = 0; i < 3; ++i)
    if (t.mirror[i]) factors[i] = -factors[i];
  auto map = mesh::stretched_along(factors);
  map = mesh::product(mesh::turned_about(0, t.rotate_x_deg), map);
  map = mesh::product(mesh::turned_about(1, t.rotate_y_deg), map);
  if (t.orient) {
    std::array<double, 3> down = t.orient->face;
    if (t.orient->automatic) {
      told.orientations = orientations_of(settings, whole(model, map, about));
      down = told.orientations.front().down;
    }
    map = mesh::product(mesh::laid_on(down), map);
    told.transforms.push_back(told_orientation(down));
  }
  map = mesh::product(mesh::turned_about(2, p.rotate_deg), map);
  if (!t.fit_mm) return map;
  std::array<std::array<double, 3>, 2> box{};
  for (const auto& object : model.objects) {
    const auto own = mesh::box_under(object.mesh, map, about);
    for (std::size_t i = 0; i < 3; ++i) {
      box[0][i] = &object == &model.objects.front() ? own[0][i] : std::min(box[0][i], own[0][i]);
      box[1][i] = &object == &model.objects.front() ? own[1][i] : std::max(box[1][i], own[1][i]);
    }
  }
  double factor = 1e9;
  for (std::size_t i = 0; i < 3; ++i)
    if (box[1][i] > box[0][i]) factor = std::min(factor, (*t.fit_mm)[i] / (box[1][i] - box[0][i]));
  told.transforms.push_back(fmt::format("scaled by {:.6g} to fit", factor));
  return mesh::product(mesh::stretched_along({factor, factor, factor}), map);
}

/// What the file says, without its objects. Its notices are told already.
mesh::Loaded file_of(const mesh::Loaded& model) {
  mesh::Loaded out{.path = model.path, .format = model.format};
  out.sha256 = model.sha256, out.unit = model.unit, out.triangles_in_file = model.triangles_in_file;
  out.author = model.author, out.items = model.items;
  return out;
}

/// One half of a model. Empty: nothing of it is there.
Typed half_of(const Typed& typed, Um z, bool upper) {
  Typed out{file_of(typed.model), {}, typed.one_object};
  for (std::size_t i = 0; i < typed.model.objects.size(); ++i) {
    mesh::Object object = typed.model.objects[i];
    const auto half = [&](const Mesh& of) {
      auto both = mesh::cut_at(of, z);
      return upper ? std::move(both.upper) : std::move(both.lower);
    };
    object.mesh = half(object.mesh);
    if (object.mesh.triangles.empty() || box_of(object.mesh).size().z == 0) continue;
    for (auto& mark : object.marks) mark.mesh = half(mark.mesh);
    std::erase_if(object.marks, [](const mesh::Mark& mark) { return mark.mesh.triangles.empty(); });
    out.model.objects.push_back(std::move(object));
    out.tools.push_back(typed.tools[i]);
  }
  return out;
}

void name_parts(Typed& typed, const std::string& what) {
  const auto stem = std::filesystem::path(typed.model.path).stem().string();
  for (auto& object : typed.model.objects)
    object.name = fmt::format("{}_{}", object.name.empty() ? stem : object.name, what);
  for (auto& item : typed.model.items) item.name = fmt::format("{}_{}", item.name.empty() ? stem : item.name, what);
}

std::vector<Typed> cut(const Placement& p, Typed typed) {
  const Box3 box = box_of_model(typed.model);
  const Um z = box.min.z + *p.transform.cut;
  if (z >= box.max.z)
    throw Error{Error::Kind::usage,
                fmt::format("{:.3f} mm above its lowest point nothing is left of {}, which is {:.3f} mm high",
                            to_mm(*p.transform.cut), typed.model.path, to_mm(box.size().z)),
                "--cut", "heights are of the model as it is scaled and turned"};
  std::vector<Typed> out;
  for (const bool upper : {false, true}) {
    if (p.transform.keep == (upper ? CutKeep::lower : CutKeep::upper)) continue;
    out.push_back(half_of(typed, z, upper));
    name_parts(out.back(), upper ? "upper" : "lower");
  }
  return out;
}

/// Each body by itself.
std::vector<Typed> split(Typed typed) {
  std::vector<Typed> out;
  for (std::size_t i = 0; i < typed.model.objects.size(); ++i) {
    auto& object = typed.model.objects[i];
    auto bodies = mesh::split(object.mesh);
    if (bodies.size() == 1 && typed.model.objects.size() == 1) return {std::move(typed)};
    for (std::size_t b = 0; b < bodies.size(); ++b) {
      Typed one{file_of(typed.model), {typed.tools[i]}, false};
      one.model.objects.push_back({object.name, std::move(bodies[b]), {}, object.marks, object.item, object.settings});
      out.push_back(std::move(one));
    }
  }
  for (std::size_t n = 0; n < out.size(); ++n) name_parts(out[n], std::to_string(n + 1));
  return out;
}

std::vector<Typed> merged(std::vector<Typed> models) {
  Typed out = std::move(models.front());
  const auto in_one = [](mesh::Loaded& model) {  // what holds for an item holds for each of its parts
    for (auto& object : model.objects) {
      const auto& item = model.items[object.item];
      object.settings.insert(object.settings.begin(), item.settings.begin(), item.settings.end());
      if (object.name.empty()) object.name = std::filesystem::path(model.path).stem().string();
      object.item = 0;
    }
  };
  in_one(out.model);
  out.model.items = {{out.model.objects.front().name, {}, {}}};
  for (std::size_t i = 1; i < models.size(); ++i) {
    in_one(models[i].model);
    std::move(models[i].model.objects.begin(), models[i].model.objects.end(), std::back_inserter(out.model.objects));
    out.tools.insert(out.tools.end(), models[i].tools.begin(), models[i].tools.end());
  }
  out.one_object = out.model.objects.size() > 1;
  std::vector<Typed> one;
  one.push_back(std::move(out));
  return one;
}

}  // namespace

void tell_transforms(const Placement& p, Report::Model& told) {
  for (const auto& word : transform_words())
    if (const auto text = word.text(p); !text.empty() && word.key != "orient")
      told.transforms.push_back(fmt::format("{} {}", word.key, text));
}

std::vector<Typed> transformed(const Settings& settings, const Placement& p, std::vector<Typed> models,
                               std::vector<Report::Model>& told) {
  const auto& t = p.transform;
  if (t.merge && models.size() > 1) models = merged(std::move(models));
  std::vector<Typed> out;
  for (std::size_t m = 0; m < models.size(); ++m) {
    const Box3 box = box_of_model(models[m].model);
    const Point3 size = box.size();
    const Point3 about{box.min.x + size.x / 2, box.min.y + size.y / 2, box.min.z + size.z / 2};
    const auto map = map_of(settings, p, models[m].model, about, told[m]);
    each_mesh(models[m].model, [&](Mesh& one) { one = mesh::transformed(std::move(one), map, about); });
    std::vector<Typed> parts;
    if (t.cut)
      parts = cut(p, std::move(models[m]));
    else
      parts.push_back(std::move(models[m]));
    for (auto& part : parts)
      if (t.split)
        for (auto& body : split(std::move(part))) out.push_back(std::move(body));
      else
        out.push_back(std::move(part));
  }
  return out;
}

}  // namespace weft::pipeline
