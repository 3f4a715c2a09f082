// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.h"
#include "core/json_text.h"
#include "limited.h"
#include "mesh/read.h"
#include "verbs.h"

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

Json facts_of(const mesh::Loaded& loaded) {
  Json objects = Json::array();
  for (const auto& object : loaded.objects) objects.push_back(facts_of(object));
  return {{"file", loaded.path}, {"format", mesh::name_of(loaded.format)},        {"sha256", loaded.sha256},
          {"unit", loaded.unit}, {"triangles_in_file", loaded.triangles_in_file}, {"objects", std::move(objects)}};
}

std::string as_text(const Json& model) {
  std::string out =
      fmt::format("{}: {}, {} triangles in the file, unit {}\n  sha256 {}\n", model["file"].get<std::string>(),
                  model["format"].get<std::string>(), model["triangles_in_file"].get<std::size_t>(),
                  model["unit"].get<std::string>(), model["sha256"].get<std::string>());
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
  return out;
}

}  // namespace

po::options_description inspect_options() {
  po::options_description out("Options of weft inspect");
  out.add_options()("format", po::value<std::string>()->value_name("text|json")->default_value("text"),
                    "form of the facts");
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
  Json models = Json::array();
  within_limits(command, [&] {
    for (const auto& path : command.inputs) models.push_back(facts_of(mesh::read_file(path)));
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
