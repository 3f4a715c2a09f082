// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "core/json_text.h"
#include "limited.h"
#include "mesh/project.h"
#include "mesh/read.h"
#include "pipeline/transform_models.h"
#include "pipeline/transform_words.h"
#include "transform_options.h"
#include "verbs.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace po = boost::program_options;

namespace weft::app {
namespace {

using Json = nlohmann::ordered_json;

Json facts_of(const mesh::Object& object) {
  const auto box = box_of(object.mesh);
  const auto size = box.size();
  Json repairs = Json::array();
  for (const auto& notice : mesh::notices_of(object.repairs, object.name.empty() ? "object" : object.name))
    repairs.push_back(notice.message);
  return {{"name", object.name},
          {"triangles", object.mesh.triangles.size()},
          {"vertices", object.mesh.vertices.size()},
          {"volume_mm3", volume_mm3(object.mesh)},
          {"min", {to_mm(box.min.x), to_mm(box.min.y), to_mm(box.min.z)}},
          {"max", {to_mm(box.max.x), to_mm(box.max.y), to_mm(box.max.z)}},
          {"size", {to_mm(size.x), to_mm(size.y), to_mm(size.z)}},
          {"repairs", std::move(repairs)}};
}

Json settings_of(const std::vector<mesh::ForeignSetting>& settings) {
  Json out = Json::object();
  for (const auto& [key, value] : settings) out[key] = value;
  return out;
}

/// What a project says of each of its objects: parts, what cuts or modifies them, settings, ranges of heights.
Json items_of(const mesh::Loaded& loaded) {
  Json out = Json::array();
  for (std::size_t i = 0; i < loaded.items.size(); ++i) {
    const auto& item = loaded.items[i];
    Json parts = Json::array(), marks = Json::array(), ranges = Json::array();
    for (const auto& object : loaded.objects) {
      if (object.item != i) continue;
      parts.push_back({{"name", object.name}, {"settings", settings_of(object.settings)}});
      for (const auto& mark : object.marks) {
        const auto row = std::find_if(mesh::mark_names.begin(), mesh::mark_names.end(),
                                      [&](const auto& r) { return r.kind == mark.kind; });
        marks.push_back({{"kind", row->name},
                         {"painted", mark.painted},
                         {"name", mark.name},
                         {"settings", settings_of(mark.settings)}});
      }
    }
    for (const auto& range : item.ranges)
      ranges.push_back(
          {{"from", to_mm(range.from)}, {"to", to_mm(range.to)}, {"settings", settings_of(range.settings)}});
    Json profile = Json::array();
    for (const auto& [z, height] : item.heights) profile.push_back({to_mm(z), to_mm(height)});
    out.push_back({{"name", item.name},
                   {"settings", settings_of(item.settings)},
                   {"parts", std::move(parts)},
                   {"volumes", std::move(marks)},
                   {"ranges", std::move(ranges)},
                   {"layers_by_height", std::move(profile)}});
  }
  return out;
}

/// What it says of the plate.
Json project_of(const mesh::Loaded& loaded) {
  const auto project = mesh::read_project(loaded.path);
  if (!project) return {};
  Json changes = Json::array(), plates = Json::array();
  for (const auto& change : project->changes) {
    constexpr std::array kinds{"colour change", "pause", "tool change", "template code", "custom code"};
    const bool known = change.kind >= 0 && change.kind < static_cast<int>(kinds.size());
    Json out{{"z", change.z_mm}, {"kind", known ? kinds[static_cast<std::size_t>(change.kind)] : "unknown"}};
    if (change.kind == 2) out["tool"] = change.extruder - 1;
    if (!change.text.empty()) out["text"] = change.text;
    if (change.plate > 0) out["plate"] = change.plate;
    changes.push_back(std::move(out));
  }
  for (const auto& plate : loaded.plates)
    plates.push_back({{"number", plate.number}, {"name", plate.name}, {"objects", plate.objects}});
  return {{"items", items_of(loaded)},
          {"plates", std::move(plates)},
          {"changes", std::move(changes)},
          {"configuration", !project->configuration.empty() || !project->json_configuration.empty()}};
}

/// "wall_loops = 5, sparse_infill_density = 60%"; empty for none.
std::string settings_text(const Json& settings) {
  std::string out;
  for (const auto& [key, value] : settings.items())
    out += (out.empty() ? "" : ", ") + fmt::format("{} = {}", key, value.get<std::string>());
  return out;
}

std::string project_text(const Json& project) {
  std::string out;
  const auto line = [&](std::size_t deep, const std::string& what, const Json& settings) {
    const auto said = settings_text(settings);
    out += std::string(deep, ' ') + what + (said.empty() ? "" : ": " + said) + "\n";
  };
  for (const auto& plate : project["plates"])
    out += fmt::format(
        "  plate {}{}: {} objects\n", plate["number"].get<int>(),
        plate["name"].get<std::string>().empty() ? "" : fmt::format(" '{}'", plate["name"].get<std::string>()),
        plate["objects"].get<std::size_t>());
  for (const auto& item : project["items"]) {
    if (item["parts"].empty()) continue;  // Cura's meshes that change others: told with those
    if (item["settings"].empty() && item["volumes"].empty() && item["ranges"].empty() &&
        item["layers_by_height"].empty() && item["parts"].size() < 2)
      continue;
    line(2, fmt::format("object '{}'", item["name"].get<std::string>()), item["settings"]);
    if (item["parts"].size() > 1)
      for (const auto& part : item["parts"])
        line(4, fmt::format("part '{}'", part["name"].get<std::string>()), part["settings"]);
    for (const auto& mark : item["volumes"])
      line(4,
           fmt::format("{}{} '{}'", mark["painted"].get<bool>() ? "painted " : "", mark["kind"].get<std::string>(),
                       mark["name"].get<std::string>()),
           mark["settings"]);
    for (const auto& range : item["ranges"])
      line(4, fmt::format("{:g} … {:g} mm", range["from"].get<double>(), range["to"].get<double>()), range["settings"]);
    if (const auto& profile = item["layers_by_height"]; !profile.empty()) {
      double low = profile[0][1].get<double>(), high = low;
      for (const auto& point : profile)
        low = std::min(low, point[1].get<double>()), high = std::max(high, point[1].get<double>());
      out += fmt::format("    layers {:g} … {:g} mm high by its profile\n", low, high);
    }
  }
  for (const auto& change : project["changes"])
    out += fmt::format("  at {:g} mm: {}{}{}\n", change["z"].get<double>(), change["kind"].get<std::string>(),
                       change.contains("tool") ? fmt::format(" to T{}", change["tool"].get<int>()) : "",
                       change.contains("text") ? ": " + change["text"].get<std::string>() : "");
  if (project["configuration"].get<bool>()) out += "  a configuration, which holds where no profile is named\n";
  return out;
}

Json facts_of(const Report::Orientation& o) {
  return {{"down", o.down},
          {"support_mm3", o.support_mm3},
          {"contact_mm2", o.contact_mm2},
          {"on_part_mm2", o.on_part_mm2},
          {"height_mm", o.height_mm},
          {"foot_mm2", o.foot_mm2},
          {"cost_mm3", o.cost_mm3}};
}

/// @param told what was done with it  @param project what a project says; null: it is none
Json facts_of(const std::vector<pipeline::Typed>& of_file, const Report::Model& told, Json project) {
  const auto& loaded = of_file.front().model;
  Json objects = Json::array();
  for (const auto& typed : of_file)
    for (const auto& object : typed.model.objects) objects.push_back(facts_of(object));
  Json out{{"file", loaded.path}, {"format", mesh::name_of(loaded.format)},        {"sha256", loaded.sha256},
           {"unit", loaded.unit}, {"triangles_in_file", loaded.triangles_in_file}, {"objects", std::move(objects)}};
  if (!told.transforms.empty()) out["transforms"] = told.transforms;
  if (!project.is_null()) out["project"] = std::move(project);
  for (const auto& o : told.orientations) out["orientations"].push_back(facts_of(o));
  return out;
}

/// A file, and what the words make of it.
Json facts_of(const std::string& path, const Command& command, const Placement& placement) {
  const auto& t = placement.transform;
  std::vector<pipeline::Typed> typed(1);
  typed[0].model =
      mesh::read_file(path, {.scale = placement.scale, .mm_per_unit = t.mm_per_unit, .sha256 = {}, .plate = -1});
  auto project = project_of(typed[0].model);
  typed[0].tools.resize(typed[0].model.objects.size());
  std::vector<Report::Model> told(1);
  pipeline::tell_transforms(placement, told[0]);
  if (pipeline::transforms(t)) {
    const bool judged = t.orient && t.orient->automatic;  // by what the settings say of support
    typed = pipeline::transformed(judged ? resolve(command).settings : Settings{}, placement, std::move(typed), told);
  }
  return facts_of(typed, told[0], std::move(project));
}

std::string as_text(const Json& model) {
  std::string out =
      fmt::format("{}: {}, {} triangles in the file, unit {}\n  sha256 {}\n", model["file"].get<std::string>(),
                  model["format"].get<std::string>(), model["triangles_in_file"].get<std::size_t>(),
                  model["unit"].get<std::string>(), model["sha256"].get<std::string>());
  for (const auto& done : model.value("transforms", Json::array()))
    out += fmt::format("  {}\n", done.get<std::string>());
  for (const auto& o : model.value("orientations", Json::array()))
    out += fmt::format(
        "  down {:.3f},{:.3f},{:.3f}: {:.0f} mm³ below overhangs, {:.1f} mm² touched, {:.1f} mm² on the part, "
        "{:.2f} mm high, foot {:.1f} mm²; costs {:.1f}\n",
        o["down"][0].get<double>(), o["down"][1].get<double>(), o["down"][2].get<double>(),
        o["support_mm3"].get<double>(), o["contact_mm2"].get<double>(), o["on_part_mm2"].get<double>(),
        o["height_mm"].get<double>(), o["foot_mm2"].get<double>(), o["cost_mm3"].get<double>());
  for (const auto& o : model["objects"]) {
    const auto name = o["name"].get<std::string>();
    out += fmt::format(
        "  {}: {:.3f} x {:.3f} x {:.3f} mm, from ({:.3f}, {:.3f}, {:.3f}), {:.2f} mm³, {} triangles, {} vertices\n",
        name.empty() ? "object" : name, o["size"][0].get<double>(), o["size"][1].get<double>(),
        o["size"][2].get<double>(), o["min"][0].get<double>(), o["min"][1].get<double>(), o["min"][2].get<double>(),
        o["volume_mm3"].get<double>(), o["triangles"].get<std::size_t>(), o["vertices"].get<std::size_t>());
    if (o["repairs"].empty()) out += "    closed and sound: nothing to repair\n";
    for (const auto& repair : o["repairs"]) out += fmt::format("    {}\n", repair.get<std::string>());
  }
  if (model.contains("project")) out += project_text(model["project"]);
  return out;
}

}  // namespace

po::options_description inspect_options() {
  po::options_description out("Options of weft inspect");
  out.add_options()("format", po::value<std::string>()->value_name("text|json")->default_value("text"),
                    "form of the facts");
  add_transform_options(out);
  add_limit_options(out);
  return out;
}

int inspect(const Words& words) {
  const auto options = inspect_options();
  const auto command = parse_command(words, options);
  if (command.help) {
    std::ostringstream out;
    out << "weft inspect MODEL...: mesh facts and what a repair would do\n\n" << options << "\n" << common_help();
    return write_output("-", out.str()), 0;
  }
  if (command.inputs.empty()) throw Error{Error::Kind::usage, "no model was given", "weft inspect"};
  const auto format = command.options["format"].as<std::string>();
  if (format != "text" && format != "json")
    throw Error{Error::Kind::usage, fmt::format("'{}' is not one of text, json", format), "--format"};
  Placement placement;
  take_transforms(command.options, placement);
  Json models = Json::array();
  within_limits(command, [&] {
    for (const auto& path : command.inputs) models.push_back(facts_of(path, command, placement));
  });
  std::string out;
  if (format == "json")
    out = json_text(models, 2) + "\n";
  else
    for (const auto& model : models) out += as_text(model);
  write_output(command.output.value_or("-"), out);
  if (command.report) write_output(*command.report, json_text(models, 2) + "\n");
  return 0;
}

}  // namespace weft::app
