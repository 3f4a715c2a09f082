// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/three_mf_parts.h"

#include "core/number.h"
#include "mesh/text.h"
#include "mesh/xml.h"

#include <optional>

namespace weft::mesh {
namespace {

std::optional<std::uint32_t> id(const XmlAttributes& attributes, std::string_view name) {
  return as_number<std::uint32_t>(Words(attributes.find(name).value_or("")).next());
}

std::optional<MarkKind> kind_called(std::string_view name, std::string_view MarkName::*column) {
  for (const auto& row : mark_names)
    if (!name.empty() && row.*column == name) return row.kind;
  return std::nullopt;
}

/// `<object id><volume firstid lastid><metadata type="volume" key="volume_type" value/>`; older files say
/// `modifier` = 1 instead.
void read_prusaslicer(Archive& archive, const std::string& path, ThreeMfParts& out) {
  const std::string part = "Metadata/Slic3r_PE_model.config";
  if (!archive.has(part)) return;
  std::optional<std::uint32_t> object;
  ThreeMfParts::Range range;
  bool in_volume = false;
  parse_xml(archive, part, path,
            {.start =
                 [&](std::string_view name, const XmlAttributes& attributes, std::size_t) {
                   if (name == "object") object = id(attributes, "id");
                   if (name == "volume") {
                     const auto first = id(attributes, "firstid"), last = id(attributes, "lastid");
                     in_volume = first && last;
                     if (in_volume) range = {*first, *last, MarkKind::modifier};
                   }
                   if (name != "metadata" || !in_volume || !object) return;
                   const auto key = attributes.find("key").value_or(""), value = attributes.find("value").value_or("");
                   std::optional<MarkKind> kind;
                   if (key == "volume_type") kind = kind_called(value, &MarkName::prusaslicer);
                   if (key == "modifier" && value == "1") kind = MarkKind::modifier;
                   if (!kind) return;
                   range.kind = *kind;
                   auto& known = out.ranges[*object];
                   if (!known.empty() && known.back().first == range.first) known.pop_back();  // both ways of saying it
                   known.push_back(range);
                 },
             .end = [&](std::string_view name) { in_volume = in_volume && name != "volume"; },
             .prefix = {}});
}

/// `<object id><part id subtype>`.
void read_orca(Archive& archive, const std::string& path, ThreeMfParts& out) {
  const std::string part = "Metadata/model_settings.config";
  if (!archive.has(part)) return;
  std::optional<std::uint32_t> object;
  parse_xml(archive, part, path,
            {.start =
                 [&](std::string_view name, const XmlAttributes& attributes, std::size_t) {
                   if (name == "object") object = id(attributes, "id");
                   const auto component = id(attributes, "id");
                   if (name != "part" || !object || !component) return;
                   if (const auto kind = kind_called(attributes.find("subtype").value_or(""), &MarkName::orca))
                     out.components[*object][*component] = *kind;
                 },
             .end = {},
             .prefix = {}});
}

}  // namespace

const MarkKind* ThreeMfParts::of_triangle(std::uint32_t object, std::size_t t) const {
  const auto known = ranges.find(object);
  if (known == ranges.end()) return nullptr;
  for (const auto& range : known->second)
    if (t >= range.first && t <= range.last) return &range.kind;
  return nullptr;
}

const MarkKind* ThreeMfParts::of_component(std::uint32_t object, std::uint32_t component) const {
  const auto known = components.find(object);
  if (known == components.end()) return nullptr;
  const auto kind = known->second.find(component);
  return kind == known->second.end() ? nullptr : &kind->second;
}

ThreeMfParts parts_of(Archive& archive, const std::string& path) {
  ThreeMfParts out;
  read_prusaslicer(archive, path, out);
  read_orca(archive, path, out);
  return out;
}

}  // namespace weft::mesh
