// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/project.h"

#include "core/file_bytes.h"
#include "mesh/archive.h"
#include "mesh/formats.h"
#include "mesh/text.h"
#include "mesh/xml.h"

#include <filesystem>

namespace weft::mesh {
namespace {

int whole(const XmlAttributes& attributes, std::string_view name) {
  const auto number = number_in(attributes.find(name).value_or(""));
  return number && *number >= -1 && *number < 10000 ? static_cast<int>(*number) : 0;
}

/// `<code print_z type extruder extra gcode/>`, in older files without a type and with the command alone.
void read_prusaslicer(Archive& archive, const std::string& path, Project& out) {
  const std::string part = "Metadata/Prusa_Slicer_custom_gcode_per_print_z.xml";
  if (!archive.has(part)) return;
  parse_xml(archive, part, path,
            {.start =
                 [&](std::string_view name, const XmlAttributes& attributes, std::size_t) {
                   const auto z = number_in(attributes.find("print_z").value_or(""));
                   if (name != "code" || !z) return;
                   ProjectChange change{*z, whole(attributes, "type"), whole(attributes, "extruder"),
                                        std::string(attributes.find("extra").value_or("")), 0};
                   const auto code = attributes.find("gcode").value_or("");
                   if (!attributes.find("type"))
                     change.kind = code == "M600" ? 0 : code == "M601" ? 1 : code == "tool_change" ? 2 : 4;
                   if (change.kind == 4 && change.text.empty()) change.text = code;
                   out.changes.push_back(std::move(change));
                 },
             .end = {},
             .prefix = {}});
}

/// `<plate><plate_info id/><layer top_z type extruder extra gcode/></plate>`.
void read_orca(Archive& archive, const std::string& path, Project& out) {
  const std::string part = "Metadata/custom_gcode_per_layer.xml";
  if (!archive.has(part)) return;
  int plate = 0;
  parse_xml(archive, part, path,
            {.start =
                 [&](std::string_view name, const XmlAttributes& attributes, std::size_t) {
                   if (name == "plate") plate = 0;
                   if (name == "plate_info") plate = whole(attributes, "id");
                   const auto z = number_in(attributes.find("top_z").value_or(""));
                   if (name == "layer" && z)
                     out.changes.push_back({*z, whole(attributes, "type"), whole(attributes, "extruder"),
                                            std::string(attributes.find("extra").value_or("")), plate});
                 },
             .end = {},
             .prefix = {}});
}

/// `<wipe_tower_information bed_idx position_x position_y rotation_deg/>` of the first bed.
void read_tower(Archive& archive, const std::string& path, Project& out) {
  const std::string part = "Metadata/Prusa_Slicer_wipe_tower_information.xml";
  if (!archive.has(part)) return;
  parse_xml(archive, part, path,
            {.start =
                 [&](std::string_view, const XmlAttributes& attributes, std::size_t) {
                   const auto of = [&](std::string_view name) { return number_in(attributes.find(name).value_or("")); };
                   const auto x = of("position_x"), y = of("position_y");
                   if (x && y && !out.tower && of("bed_idx").value_or(0) == 0)
                     out.tower = Project::Tower{*x, *y, of("rotation_deg").value_or(0)};
                 },
             .end = {},
             .prefix = {}});
}

}  // namespace

std::optional<Project> read_project(const std::string& path) {
  std::error_code unknown;
  if (!std::filesystem::is_regular_file(path, unknown)) return std::nullopt;
  InputFile file(path);
  char bytes[4];
  if (!is_3mf({bytes, file.front(bytes, sizeof bytes)})) return std::nullopt;
  const FileBytes content(file);
  Archive archive(content.view(), path);
  Project out;
  if (const std::string part = "Metadata/Slic3r_PE.config"; archive.has(part)) {
    out.author = Author::prusaslicer;
    out.configuration = archive.text(part);
  }
  if (const std::string part = "Metadata/project_settings.config"; archive.has(part)) {
    out.author = Author::orca;
    out.json_configuration = archive.text(part);
  }
  read_tower(archive, path, out);
  read_prusaslicer(archive, path, out);
  read_orca(archive, path, out);
  return out;
}

}  // namespace weft::mesh
