// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/three_mf_parts.h"

#include "core/number.h"
#include "mesh/layer_profile.h"
#include "mesh/text.h"
#include "mesh/weld.h"
#include "mesh/xml.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>

namespace weft::mesh {
namespace {

std::optional<std::uint32_t> whole(std::string_view text) {
  return as_number<std::uint32_t>(Words(text).next());
}
std::optional<std::uint32_t> id(const XmlAttributes& attributes, std::string_view name) {
  return whole(attributes.find(name).value_or(""));
}

std::optional<MarkKind> kind_called(std::string_view name, std::string_view MarkName::*column) {
  for (const auto& row : mark_names)
    if (!name.empty() && row.*column == name) return row.kind;
  return std::nullopt;
}

/// Where a volume comes from and how it was made: nothing of it is a setting.
bool is_of_the_making(std::string_view key) {
  constexpr std::array<std::string_view, 8> keys{"name",   "modifier", "volume_type", "matrix",
                                                 "module", "text",     "thumbnail",   "face_count"};
  return key.empty() || key.starts_with("source_") || std::find(keys.begin(), keys.end(), key) != keys.end();
}

/// A line of metadata of an object or a volume.
template <class Said>
void take(Said& said, std::string_view key, std::string_view value) {
  if (key == "name") said.name = value;
  if (!is_of_the_making(key) && !(key == "extruder" && value == "0"))
    said.settings.push_back({std::string(key), std::string(value)});
}

/// `<object id><metadata type="object" key value/><volume firstid lastid><metadata type="volume" key value/>`; of a
/// volume `volume_type` says what it is, in older files `modifier` = 1.
void read_prusaslicer(Archive& archive, const std::string& path, ThreeMfParts& out) {
  const std::string part = "Metadata/Slic3r_PE_model.config";
  if (!archive.has(part)) return;
  out.author = Author::prusaslicer;
  ObjectSaid* object = nullptr;
  VolumeSaid* volume = nullptr;
  parse_xml(archive, part, path,
            {.start =
                 [&](std::string_view name, const XmlAttributes& attributes, std::size_t) {
                   if (name == "object") {
                     const auto number = id(attributes, "id");
                     object = number ? &out.objects[*number] : nullptr;
                   }
                   if (name == "volume" && object) {
                     const auto first = id(attributes, "firstid"), last = id(attributes, "lastid");
                     if (first && last) {
                       object->volumes.push_back({*first, *last, object->volumes.size()});
                       volume = &object->volumes.back();
                     }
                   }
                   if (name != "metadata" || !object) return;
                   const auto key = attributes.find("key").value_or(""), value = attributes.find("value").value_or("");
                   if (!volume) return take(*object, key, value);
                   if (key == "volume_type") {
                     volume->kind = kind_called(value, &MarkName::prusaslicer);
                     if (!volume->kind && value != "ModelPart") out.unknown_kinds.emplace_back(value);
                   }
                   if (key == "modifier" && value == "1" && !volume->kind) volume->kind = MarkKind::modifier;
                   take(*volume, key, value);
                 },
             .end =
                 [&](std::string_view name) {
                   if (name == "volume") volume = nullptr;
                   if (name == "object") object = nullptr;
                 },
             .prefix = {}});
}

/// `<object id><metadata key value/><part id subtype><metadata key value/>`, and `<plate>` with its instances.
void read_orca(Archive& archive, const std::string& path, ThreeMfParts& out) {
  const std::string part = "Metadata/model_settings.config";
  if (!archive.has(part)) return;
  out.author = Author::orca;
  ObjectSaid* object = nullptr;
  VolumeSaid* volume = nullptr;
  PlateSaid* plate = nullptr;
  const auto of_plate = [&](std::string_view key, std::string_view value) {
    auto& instances = plate->instances;
    if (key == "plater_id") plate->number = static_cast<int>(whole(value).value_or(0));
    if (key == "plater_name") plate->name = value;
    if (key == "object_id") instances.emplace_back(whole(value).value_or(0), 0);
    if (key == "instance_id" && !instances.empty()) instances.back().second = whole(value).value_or(0);
  };
  parse_xml(archive, part, path,
            {.start =
                 [&](std::string_view name, const XmlAttributes& attributes, std::size_t) {
                   const auto number = id(attributes, "id");
                   if (name == "object") object = number ? &out.objects[*number] : nullptr;
                   if (name == "plate") plate = &out.plates.emplace_back();
                   if (name == "part" && object && number) {
                     const std::size_t place = object->components.size();
                     volume = &object->components[*number];
                     volume->number = place;
                     const auto subtype = attributes.find("subtype").value_or("");
                     volume->kind = kind_called(subtype, &MarkName::orca);
                     if (!volume->kind && !subtype.empty() && subtype != "normal_part")
                       out.unknown_kinds.emplace_back(subtype);
                   }
                   if (name != "metadata") return;
                   const auto key = attributes.find("key").value_or(""), value = attributes.find("value").value_or("");
                   if (plate)
                     of_plate(key, value);
                   else if (volume)
                     take(*volume, key, value);
                   else if (object)
                     take(*object, key, value);
                 },
             .end =
                 [&](std::string_view name) {
                   if (name == "part") volume = nullptr;
                   if (name == "object") object = nullptr;
                   if (name == "plate") plate = nullptr;
                 },
             .prefix = {}});
}

/// `<object id><range min_z max_z><option opt_key>value</option>`.
void read_ranges(Archive& archive, const std::string& path, const std::string& part, ThreeMfParts& out) {
  if (!archive.has(part)) return;
  std::optional<std::uint32_t> object;
  RangeOfItem range;
  std::string key, text;
  parse_xml(archive, part, path,
            {.start =
                 [&](std::string_view name, const XmlAttributes& attributes, std::size_t) {
                   if (name == "object") object = id(attributes, "id");
                   const auto height = [&](std::string_view of) {
                     const auto mm = number_in(attributes.find(of).value_or("")).value_or(0);
                     return placeable(mm) ? lattice(mm) : Um{0};
                   };
                   if (name == "range") range = {height("min_z"), height("max_z"), {}};
                   if (name == "option") key = attributes.find("opt_key").value_or(""), text.clear();
                 },
             .end =
                 [&](std::string_view name) {
                   if (name == "option" && !key.empty() && !(key == "extruder" && text == "0"))
                     range.settings.push_back({key, text});
                   if (name == "option") key.clear();
                   if (name == "range" && object && range.from < range.to) out.ranges[*object].push_back(range);
                 },
             .prefix = {},
             .text_in = "option",
             .text =
                 [&](std::string_view piece) {
                   if (!key.empty()) text += piece;
                 }});
}

/// Parts that say something of the print, of which the reader knows nothing.
std::vector<std::string> unread_of(const Archive& archive) {
  // What is read, here or by project.cpp, and what only shows or remembers.
  constexpr std::array<std::string_view, 19> known{"slic3r_pe.config",
                                                   "slic3r_pe_model.config",
                                                   "slic3r_pe_layer_heights_profile.txt",
                                                   "prusa_slicer_layer_config_ranges.xml",
                                                   "prusa_slicer_custom_gcode_per_print_z.xml",
                                                   "prusa_slicer_wipe_tower_information.xml",
                                                   "model_settings.config",
                                                   "project_settings.config",
                                                   "layer_config_ranges.xml",
                                                   "layer_heights_profile.txt",
                                                   "custom_gcode_per_layer.xml",
                                                   "slice_info.config",
                                                   "prusa_slicer_cut_information.xml",
                                                   "cut_information.xml",
                                                   "filament_sequence.json",
                                                   "slic3r.xml",
                                                   "core.xml",
                                                   "model.rels",
                                                   "model_settings.config.rels"};
  std::vector<std::string> out;
  for (const auto& part : archive.parts()) {
    auto name = part;
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    constexpr std::string_view folder = "metadata/", cura = "cura/", profiles = "Cura/ (its profiles)";
    if (name.starts_with(cura) && (out.empty() || out.back() != profiles)) out.emplace_back(profiles);
    if (!name.starts_with(folder) || name.ends_with('/')) continue;
    const auto file = std::string_view(name).substr(name.rfind('/') + 1);
    const bool shows = file.ends_with(".png") || file.ends_with(".jpg") || file.ends_with(".rels") ||
                       (file.starts_with("plate_") && file.ends_with(".json"));
    if (!shows && std::find(known.begin(), known.end(), file) == known.end()) out.push_back(part);
  }
  return out;
}

void read_profiles(Archive& archive, const std::string& path, const std::string& part, ThreeMfParts& out) {
  if (!archive.has(part)) return;
  std::string text;
  archive.read(part, [&](std::string_view piece) { text += piece; });
  out.heights.merge(layer_profiles(text, path));
}

}  // namespace

const ObjectSaid* ThreeMfParts::of(std::uint32_t object) const {
  const auto known = objects.find(object);
  return known == objects.end() ? nullptr : &known->second;
}

const VolumeSaid* ThreeMfParts::of_triangle(std::uint32_t object, std::size_t t) const {
  const auto* said = of(object);
  if (!said) return nullptr;
  for (const auto& volume : said->volumes)
    if (t >= volume.first && t <= volume.last) return &volume;
  return nullptr;
}

const VolumeSaid* ThreeMfParts::of_component(std::uint32_t object, std::uint32_t component) const {
  const auto* said = of(object);
  if (!said) return nullptr;
  const auto volume = said->components.find(component);
  return volume == said->components.end() ? nullptr : &volume->second;
}

ThreeMfParts parts_of(Archive& archive, const std::string& path) {
  ThreeMfParts out;
  read_prusaslicer(archive, path, out);
  read_orca(archive, path, out);
  read_ranges(archive, path, "Metadata/Prusa_Slicer_layer_config_ranges.xml", out);
  read_ranges(archive, path, "Metadata/layer_config_ranges.xml", out);
  read_profiles(archive, path, "Metadata/Slic3r_PE_layer_heights_profile.txt", out);
  read_profiles(archive, path, "Metadata/layer_heights_profile.txt", out);
  out.unread = unread_of(archive);
  return out;
}

}  // namespace weft::mesh
