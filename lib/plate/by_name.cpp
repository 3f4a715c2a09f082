// SPDX-License-Identifier: GPL-3.0-or-later
#include "plate/by_name.h"

#include "core/error.h"
#include "core/json_text.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Named& named) {
  if (!named.model) return named.name;
  Json out = Json::array({*named.model});
  if (named.part) out.push_back(*named.part);
  return out;
}

Named named_of(const Json& json) {
  if (json.is_string()) return {json.get<std::string>(), {}, {}};
  Named out;
  out.model = json.at(0).get<std::size_t>();
  if (json.size() > 1) out.part = json.at(1).get<std::size_t>();
  return out;
}

}  // namespace

std::string text_of(const ByName& said) {
  Json settings = Json::array(), places = Json::array(), copies = Json::array();
  for (const auto& s : said.settings) settings.push_back(Json::array({json_of(s.of), s.key, s.text}));
  for (const auto& p : said.places) places.push_back(Json::array({json_of(p.of), p.at.x, p.at.y, p.rotate_deg}));
  for (const auto& c : said.copies) copies.push_back(Json::array({json_of(c.of), c.count}));
  return json_text(Json{{"for", std::move(settings)}, {"place", std::move(places)}, {"copies", std::move(copies)}});
}

ByName by_name_of(std::string_view text) {
  try {
    const auto json = Json::parse(text);
    ByName out;
    for (const auto& s : json.at("for"))
      out.settings.push_back({named_of(s.at(0)), s.at(1).get<std::string>(), s.at(2).get<std::string>(), {}});
    for (const auto& p : json.at("place"))
      out.places.push_back({named_of(p.at(0)), {p.at(1).get<Um>(), p.at(2).get<Um>()}, p.at(3).get<double>()});
    for (const auto& c : json.at("copies")) out.copies.push_back({named_of(c.at(0)), c.at(1).get<int>()});
    return out;
  } catch (const Json::exception&) {
    throw std::invalid_argument("is not what weft writes there");
  }
}

namespace plate {
namespace {

/// Is the model called so: as typed, or by its file's name?
bool is_called(const std::string& typed, const std::string& name) {
  const std::filesystem::path path(typed);
  return typed == name || path.filename() == name || path.stem() == name;
}

bool means_part(const Named& named, const Plate& plate, const Origins& origins, std::size_t object,
                std::size_t volume) {
  if (named.model) return named.part && *named.model == origins.model[object] && *named.part == volume;
  const auto& v = plate.objects[object].volumes[volume];
  return v.name == named.name || is_called(v.name, named.name);
}

/// What could have been meant.
std::string names_on(const Plate& plate) {
  std::set<std::string> names;
  for (const auto& object : plate.objects) {
    names.insert(object.name);
    for (const auto& volume : object.volumes) names.insert(volume.name);
  }
  names.erase("");
  std::string out;
  std::size_t count = 0;
  for (const auto& name : names)
    if (++count <= 8) out += (out.empty() ? "" : ", ") + name;
  return "there are " + out + (names.size() > 8 ? fmt::format(" and {} more", names.size() - 8) : "");
}

[[noreturn]] void refuse(const Named& named, const Plate& plate, const std::string& option) {
  throw Error{Error::Kind::usage,
              named.model ? fmt::format("there is no part {} of model {}", named.part.value_or(0), *named.model)
                          : fmt::format("no object and no part is called '{}'", named.name),
              option, names_on(plate)};
}

/// What G-code says of where a value comes from: the same whoever said it, so that it can be made again.
std::string place_of(const Named& named) {
  if (!named.model) return "--for " + named.name;
  return named.part ? fmt::format("model {}, part {}", *named.model, *named.part)
                    : fmt::format("model {}", *named.model);
}

void add(const ByName::Setting& setting, Overlay& to, const std::string& what, Scope scope) {
  to.what = what, to.scope = scope;
  to.add(setting.key, setting.text, place_of(setting.of));
}

}  // namespace

bool means(const Named& named, const Plate& plate, const Origins& origins, std::size_t object) {
  if (named.model) return !named.part && *named.model == origins.model[object];
  return plate.objects[object].name == named.name || is_called(origins.typed[object], named.name);
}

void lay_by_name(const ByName& said, Plate& plate, const Origins& origins) {
  for (const auto& setting : said.settings) {
    bool found = false;
    for (std::size_t o = 0; o < plate.objects.size(); ++o) {
      auto& object = plate.objects[o];
      if (means(setting.of, plate, origins, o)) {
        add(setting, object.said, fmt::format("object '{}'", object.name), Scope::object);
        found = true;
        continue;
      }
      for (std::size_t v = 0; v < object.volumes.size(); ++v) {
        if (!means_part(setting.of, plate, origins, o, v)) continue;
        auto& volume = object.volumes[v];
        const bool is_part = volume.kind == VolumeKind::model;
        add(setting, volume.said, fmt::format("{} '{}'", is_part ? "part" : name_of(volume.kind), volume.name),
            Scope::region);
        found = true;
      }
    }
    if (!found) refuse(setting.of, plate, setting.where.empty() ? place_of(setting.of) : setting.where);
  }
  const auto check = [&](const Named& named, const char* option) {
    for (std::size_t o = 0; o < plate.objects.size(); ++o)
      if (means(named, plate, origins, o)) return;
    refuse(named, plate, option);
  };
  for (const auto& place : said.places) check(place.of, "--place");
  for (const auto& copies : said.copies) check(copies.of, "--copies");
}

}  // namespace plate
}  // namespace weft
