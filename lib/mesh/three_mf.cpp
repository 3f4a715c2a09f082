// SPDX-License-Identifier: GPL-3.0-or-later
#include "mesh/three_mf.h"

#include "core/error.h"
#include "core/escape.h"
#include "core/number.h"
#include "mesh/text.h"
#include "mesh/three_mf_colours.h"
#include "mesh/xml.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <set>

#include <fmt/format.h>

namespace weft::mesh {
namespace {

constexpr std::string_view materials = "http://schemas.microsoft.com/3dmanufacturing/material/2015/02|";
constexpr std::string_view production = "http://schemas.microsoft.com/3dmanufacturing/production/2015/06";

/// Extensions that a file may require: they add nothing to the shape, or are read.
constexpr std::array<std::string_view, 5> harmless_extensions = {
    production, "http://schemas.microsoft.com/3dmanufacturing/core/2015/02",
    "http://schemas.microsoft.com/3dmanufacturing/material/2015/02",
    "http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07", "http://schemas.bambulab.com/package/2021"};

struct Unit {
  std::string_view name;
  double mm;
};
constexpr std::array<Unit, 6> units = {
    {{"micron", 0.001}, {"millimeter", 1}, {"centimeter", 10}, {"inch", 25.4}, {"foot", 304.8}, {"meter", 1000}}};

/// PrusaSlicer's namespace is an address, and the attributes of what is painted for support and for extruders in it.
constexpr std::string_view painted_by_prusaslicer = "http://schemas.slic3r.org/3mf/2017/06|custom_supports";
constexpr std::string_view tinted_by_prusaslicer = "http://schemas.slic3r.org/3mf/2017/06|mmu_segmentation";

/// What Cura's settings of an object are called in its metadata.
constexpr std::string_view of_cura = "cura:";

std::string part_name(std::string_view target) {
  while (target.starts_with('/')) target.remove_prefix(1);
  return std::string(target);
}

std::string_view local(std::string_view name) {
  return name.substr(name.rfind('|') + 1);
}

/// Reads one model part into the document.
class ModelPart {
 public:
  ModelPart(ThreeMf& document, std::string part, const std::string& path, bool root)
      : document_(document), part_(std::move(part)), path_(path), root_(root) {}

  void parse(Archive& archive) {
    parse_xml(archive, part_, path_,
              {.start = [this](auto name, const auto& attributes, auto line) { start(name, attributes, line); },
               .end = [this](auto name) { end(name); },
               .prefix = [this](auto prefix, auto uri) { prefixes_[std::string(prefix)] = uri; },
               .text_in = "metadata",
               .text =
                   [this](auto piece) {
                     if (!setting_.empty()) object_->settings.back().value += piece;
                   }});
  }

 private:
  void start(std::string_view full_name, const XmlAttributes& attributes, std::size_t line) {
    line_ = line;
    const std::string_view name = local(full_name);
    if (core_.empty()) {  // the root element
      if (name != "model") refuse(fmt::format("expected <model>, found <{}>", name), "export the model again");
      core_ = full_name.substr(0, full_name.size() - name.size());
      return model(attributes);
    }
    if (full_name.starts_with(materials)) return material(name, attributes);
    if (!full_name.starts_with(core_) || full_name.size() != core_.size() + name.size()) return;
    if (name == "vertex" && object_)
      // braces: of several wrong ones the first is told, whatever order a compiler takes arguments in
      object_->vertices.push_back(
          Eigen::Vector3d{number(attributes, "x"), number(attributes, "y"), number(attributes, "z")});
    else if (name == "triangle" && object_)
      triangle(attributes);
    else if (name == "object")
      object(attributes);
    else if (name == "basematerials")
      begin_group(attributes);
    else if (name == "base")
      groups_.add(colour_of(attributes.find("displaycolor").value_or("")));
    else if (name == "component" && object_)
      object_->components.push_back(reference(attributes));
    else if (name == "item" && root_)
      item(attributes);
    else if (name == "metadata" && object_ && attributes.find("name").value_or("").starts_with(of_cura)) {
      setting_ = attributes.find("name")->substr(of_cura.size());
      object_->settings.push_back({setting_, {}});
    }
  }

  void end(std::string_view name) {
    if (local(name) == "metadata") setting_.clear();
    if (local(name) == "basematerials" || local(name) == "colorgroup") groups_.end();
    if (local(name) == "object" && name.starts_with(core_) && object_) settle_colours(*object_), object_ = nullptr;
  }

  void begin_group(const XmlAttributes& attributes) {
    if (const auto number = property(attributes, "id")) groups_.begin(*number);
  }
  /// The number of a group or of a property; nothing where there is none: a model is not refused for its colours.
  static std::optional<std::uint32_t> property(const XmlAttributes& attributes, std::string_view name) {
    return as_number<std::uint32_t>(Words(attributes.find(name).value_or("")).next());
  }

  /// Of textures and mixtures nothing is printed: that is told once.
  void material(std::string_view name, const XmlAttributes& attributes) {
    if (name == "colorgroup") return begin_group(attributes);
    if (name == "color") return groups_.add(colour_of(attributes.find("color").value_or("")));
    const bool other = name == "texture2dgroup" || name == "compositematerials" || name == "multiproperties";
    if (!other || told_textures_) return;
    told_textures_ = true;
    document_.notices.push_back(
        {"mesh_texture_left_out",
         fmt::format("{}: {} are left out: surfaces have the colours of plain groups only", where(),
                     name == "texture2dgroup" ? "textures" : "mixtures of materials")});
  }

  void model(const XmlAttributes& attributes) {
    const std::string_view unit = attributes.find("unit").value_or("millimeter");
    const auto known = std::find_if(units.begin(), units.end(), [&](const Unit& u) { return u.name == unit; });
    if (known == units.end())
      refuse(fmt::format("unknown unit {}", escape::message(unit)),
             "3MF knows micron, millimeter, centimeter, inch, foot, meter");
    if (!root_ && unit != document_.unit)
      refuse(fmt::format("unit {}, but the root model's is {}", unit, document_.unit), "export the model in one file");
    document_.unit = unit;
    document_.mm_per_unit = known->mm;
    Words required(attributes.find("requiredextensions").value_or(""));
    for (std::string_view prefix = required.next(); !prefix.empty(); prefix = required.next()) {
      const std::string& uri = prefixes_[std::string(prefix)];
      if (std::find(harmless_extensions.begin(), harmless_extensions.end(), uri) == harmless_extensions.end())
        refuse(fmt::format("needs the 3MF extension {} ({})", escape::message(prefix), uri), "export plain triangles");
    }
  }

  void object(const XmlAttributes& attributes) {
    const ObjectKey key{part_, id(attributes, "id")};
    const auto [at, fresh] = document_.objects.try_emplace(key);
    if (!fresh) refuse(fmt::format("a second object with id {}", key.second), "export the model again");
    object_ = &at->second;
    object_id_ = key.second;
    object_->name = attributes.find("name").value_or("");
    object_->type = attributes.find("type").value_or("model");
    group_ = property(attributes, "pid");
    const auto index = property(attributes, "pindex");
    if (group_ && index) object_->colour = groups_.find(*group_, *index);
  }

  void triangle(const XmlAttributes& attributes) {
    Triangle corners;
    constexpr std::array<std::string_view, 3> names = {"v1", "v2", "v3"};
    for (std::size_t i = 0; i < 3; ++i) {
      corners[i] = id(attributes, names[i]);
      if (corners[i] >= object_->vertices.size())
        refuse(fmt::format("object {}, triangle {}: {} is {}, but there are {} vertices", object_id_,
                           object_->triangles.size() + 1, names[i], corners[i], object_->vertices.size()),
               "export the model again");
    }
    paint(attributes, corners);
    colour(attributes);
    object_->triangles.push_back(corners);
  }

  /// Where the corners differ it is a gradient: its first corner's colour is that of all, as the specification asks of
  /// programs that print none.
  void colour(const XmlAttributes& attributes) {
    const auto own = property(attributes, "pid"), group = own ? own : group_, index = property(attributes, "p1");
    if (!group || !index) return;
    if (const auto found = groups_.find(*group, *index))
      object_->coloured.push_back({static_cast<std::uint32_t>(object_->triangles.size()), *found});
  }

  void paint(const XmlAttributes& attributes, const Triangle& corners) {
    paint(attributes, corners, {painted_by_prusaslicer, "paint_supports"}, painted_facets, object_->painted);
    paint(attributes, corners, {tinted_by_prusaslicer, "paint_color"}, tinted_facets, object_->tinted);
  }
  template <class Read, class Facets>
  void paint(const XmlAttributes& attributes, const Triangle& corners, std::array<std::string_view, 2> names,
             const Read& read, Facets& to) {
    for (const auto name : names) {
      const auto text = attributes.find(name);
      if (!text || text->empty()) continue;
      const auto& v = object_->vertices;
      const auto facets = read(*text, {v[corners[0]], v[corners[1]], v[corners[2]]});
      if (!facets)
        refuse(fmt::format("object {}, triangle {}: {} {} ends inside a split triangle, or is not hexadecimal",
                           object_id_, object_->triangles.size() + 1, local(name), escape::message(*text)),
               "export the model again");
      to.insert(to.end(), facets->begin(), facets->end());
      return;
    }
  }

  void item(const XmlAttributes& attributes) {
    if (attributes.find("printable") == "0") {  // written by PrusaSlicer and its relatives
      document_.notices.push_back(
          {"mesh_item_not_printable",
           fmt::format("{}: an item that the file marks as not printable was left out", where())});
      return;
    }
    document_.items.push_back(reference(attributes));
  }

  Reference reference(const XmlAttributes& attributes) const {
    const auto other = attributes.find(production_path_);
    Reference result{{other ? part_name(*other) : part_, id(attributes, "objectid")}, {}, where()};
    result.transform = transform(attributes);
    return result;
  }

  /// "m00 m01 m02 m10 ... m32": rows of a matrix that is multiplied from the right, the last row the translation.
  Eigen::Affine3d transform(const XmlAttributes& attributes) const {
    Eigen::Affine3d result = Eigen::Affine3d::Identity();
    const auto text = attributes.find("transform");
    if (!text) return result;
    Words words(*text);
    for (Eigen::Index row = 0; row < 4; ++row)
      for (Eigen::Index column = 0; column < 3; ++column) {
        const auto value = number_in(words.next());
        if (!value || !std::isfinite(*value))
          refuse(fmt::format("transform {} is not 12 numbers", escape::message(*text)), "export the model again");
        result.matrix()(column, row) = *value;
      }
    if (!words.next().empty() || result.linear().determinant() == 0)
      refuse(fmt::format("transform {} is not one of space", escape::message(*text)), "export the model again");
    return result;
  }

  double number(const XmlAttributes& attributes, std::string_view name) const {
    const std::string_view text = attributes.find(name).value_or("");
    const auto value = number_in(Words(text).next());
    if (!value || !std::isfinite(*value))
      refuse(fmt::format("object {}, vertex {}: {} is {}, not a number", object_id_, object_->vertices.size(), name,
                         escape::message(text)),
             "export the model again");
    return *value;
  }

  std::uint32_t id(const XmlAttributes& attributes, std::string_view name) const {
    const std::string_view text = Words(attributes.find(name).value_or("")).next();
    const auto value = as_number<std::uint32_t>(text);
    if (!value)
      refuse(fmt::format("{} is {}, not a whole number", name, escape::message(text)), "export the model again");
    return *value;
  }

  std::string where() const { return fmt::format("{}/{}:{}", path_, part_, line_); }

  [[noreturn]] void refuse(std::string what, std::string hint) const {
    throw Error(Error::Kind::model, std::move(what), where(), std::move(hint));
  }

  ThreeMf& document_;
  const std::string part_;
  const std::string& path_;
  const bool root_;
  const std::string production_path_ = std::string(production) + "|path";
  std::string core_;  ///< "namespace|" of the root element
  std::map<std::string, std::string> prefixes_;
  PropertyGroups groups_;
  std::optional<std::uint32_t> group_{};  ///< of the object
  bool told_textures_ = false;
  Resource* object_ = nullptr;  ///< that we are in
  std::uint32_t object_id_ = 0;
  std::string setting_;  ///< that we are in
  std::size_t line_ = 0;
};

/// The name of the model part, which the package's relationships tell.
std::string root_part(Archive& archive, const std::string& path) {
  const std::string relationships = "_rels/.rels";
  std::string part;
  if (archive.has(relationships))
    parse_xml(archive, relationships, path,
              {.start =
                   [&](auto name, const auto& attributes, auto) {
                     if (local(name) == "Relationship" && part.empty() &&
                         attributes.find("Type").value_or("").ends_with("/3dmanufacturing/2013/01/3dmodel"))
                       part = part_name(attributes.find("Target").value_or(""));
                   },
               .end = {},
               .prefix = {}});
  if (part.empty())
    throw Error(Error::Kind::model, "an archive, but no 3MF: it names no model part", path,
                "unpack it, or export a 3MF");
  return part;
}

}  // namespace

ThreeMf parse_3mf(Archive& archive, const std::string& path) {
  ThreeMf document;
  const std::string root = root_part(archive, path);
  ModelPart(document, root, path, true).parse(archive);
  std::set<std::string> others;
  for (const auto& [key, object] : document.objects)
    for (const Reference& component : object.components) others.insert(component.object.first);
  for (const Reference& item : document.items) others.insert(item.object.first);
  others.erase(root);
  for (const std::string& part : others) ModelPart(document, part, path, false).parse(archive);
  document.root = root;
  document.parts = parts_of(archive, path);
  if (std::any_of(document.objects.begin(), document.objects.end(),
                  [](const auto& object) { return !object.second.settings.empty(); }))
    document.parts.author = Author::cura;
  tell_colours(document);
  return document;
}

}  // namespace weft::mesh
