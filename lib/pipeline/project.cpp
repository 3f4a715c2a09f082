// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/project.h"

#include "core/error.h"
#include "mesh/project.h"
#include "pipeline/model_parts.h"
#include "prusaslicer/orca.h"
#include "settings/catalogue.h"
#include "settings/tools.h"
#include "settings/value.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace weft {
namespace {

/// The setting that a change at a height adds to.
struct ChangeRow {
  mesh::AtHeight kind;
  std::string_view key;
};
constexpr std::array change_rows{ChangeRow{mesh::AtHeight::colour_change, "color_change_at_heights"},
                                 ChangeRow{mesh::AtHeight::pause, "pause_at_heights"},
                                 ChangeRow{mesh::AtHeight::tool_change, "tool_change_at_heights"},
                                 ChangeRow{mesh::AtHeight::custom_code, "gcode_at_heights"}};

/// The change lies below the layer that has its top there.
std::string mark_of(const mesh::ProjectChange& change, mesh::AtHeight kind) {
  std::string text = change.text;
  if (kind == mesh::AtHeight::colour_change) text.clear();
  if (kind == mesh::AtHeight::tool_change) text = fmt::format("T{}", std::max(change.extruder - 1, 0));
  std::string line;
  for (const char c : text) {
    if (c == '\n')
      line += "\\n";
    else if (c != '\r')
      line += c;
  }
  const HeightMarks one{{from_mm(change.z_mm) - 1, line}};
  return value::print(one, Unit::none);
}

/// Its values, as PrusaSlicer's inis have them. What is no JSON has none.
std::vector<std::pair<std::string, std::string>> values_in(const std::string& text) {
  using Json = nlohmann::ordered_json;
  const auto json = Json::parse(text, nullptr, false);
  std::vector<std::pair<std::string, std::string>> out;
  if (!json.is_object()) return out;
  const auto word = [](const Json& v, bool quoted) {
    const std::string plain = v.is_string() ? v.get<std::string>() : v.is_primitive() ? v.dump() : std::string();
    std::string line;
    for (const char c : plain)
      if (c == '\n')
        line += "\\n";
      else if (c != '\r')
        line += quoted && (c == '"' || c == '\\') ? std::string{'\\', c} : std::string(1, c);
    return quoted ? '"' + line + '"' : line;
  };
  const auto is_text = [](const std::string& key) {
    return key.ends_with("gcode") || key.ends_with("colour") || key.ends_with("_type") || key.ends_with("_id");
  };
  for (const auto& [key, value] : json.items()) {
    std::string joined;
    if (!value.is_array()) joined = word(value, false);
    for (const auto& item : value.is_array() ? value : Json::array()) {
      if (!joined.empty()) joined += is_text(key) ? ';' : ',';
      joined += word(item, is_text(key));
    }
    out.emplace_back(key, joined);
  }
  return out;
}

/// @return whether there was one
bool apply_json(Profile& profile, const mesh::Project& project, const std::string& path, const ImportOptions& options) {
  if (project.json_configuration.empty()) return false;
  const auto configuration = prusaslicer::orca_configuration(values_in(project.json_configuration));
  ImportOptions inside = options;
  apply_text(profile, configuration.ini, path, inside);
  for (const auto& [key, text] : configuration.ours) apply_value(profile, key, text, path);
  if (!configuration.left_out.empty()) {
    std::string names;
    for (const auto& key : configuration.left_out) names += (names.empty() ? "" : ", ") + key;
    profile.notices.push_back({"project_setting_left_out", fmt::format("{}: {} settings of its plate are left out: {}",
                                                                       path, configuration.left_out.size(), names)});
  }
  return true;
}

/// Where its tower stands, where there will be one.
void apply_tower(Profile& profile, const mesh::Project& project, const std::string& path) {
  if (!project.tower || tool_count(profile.settings) < 2) return;
  apply_value(profile, "prime_tower_position_x", value::number(project.tower->x_mm, 3), path);
  apply_value(profile, "prime_tower_position_y", value::number(project.tower->y_mm, 3), path);
  apply_value(profile, "prime_tower_angle", value::number(project.tower->angle_deg, 3), path);
}

void apply_changes(Profile& profile, const mesh::Project& project, const std::string& path, int plate) {
  for (const auto& change : project.changes) {
    if (change.plate > 1 && change.plate != plate) continue;
    if (change.plate == 1 && plate > 1) continue;
    const auto left_out = [&](const std::string& why) {
      profile.notices.push_back(
          {"project_change_left_out",
           fmt::format("{}: what is to happen at {} mm is left out: {}", path, value::number(change.z_mm, 3), why)});
    };
    const auto row = std::find_if(change_rows.begin(), change_rows.end(),
                                  [&](const ChangeRow& r) { return static_cast<int>(r.kind) == change.kind; });
    if (row == change_rows.end() || !(change.z_mm >= 0.002 && change.z_mm < 16000)) {  // mark_of is above 0
      left_out(row == change_rows.end() ? fmt::format("weft has nothing of kind {}", change.kind) : "no such height");
      continue;
    }
    if (row->kind == mesh::AtHeight::tool_change && change.extruder > static_cast<int>(tool_count(profile.settings))) {
      left_out(fmt::format("there is no tool {}", change.extruder - 1));
      continue;
    }
    const auto* entry = find_setting(std::string(row->key));
    const auto before = entry->print(profile.settings);
    apply_value(profile, std::string(row->key), before + (before.empty() ? "" : "; ") + mark_of(change, row->kind),
                path);
  }
}

/// By its name: a batch opens no file that did not change, and a project under another name is a model like any other.
bool may_be_project(const std::string& path) {
  auto ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending == ".3mf";
}

}  // namespace

bool apply_project(Profile& profile, const std::vector<std::string>& models, bool alone, int plate,
                   const ImportOptions& options) {
  bool said = false;
  for (const auto& typed : models)
    for (const auto& part : pipeline::parts_of(typed)) {
      if (!may_be_project(part.file)) continue;
      const auto project = mesh::read_project(part.file);
      if (!project) continue;
      const bool configured = !project->configuration.empty() || !project->json_configuration.empty();
      said = said || (alone && configured) || !project->changes.empty();
      if (alone && configured) {
        ImportOptions inside = options;
        const auto before = profile.origins.size();
        if (!apply_json(profile, *project, part.file, options))
          apply_text(profile, project->configuration, part.file, inside);
        if (profile.origins.size() == before)
          throw Error{Error::Kind::settings, "its settings cannot be read: they are damaged, or of another program",
                      part.file, "name a profile"};
        profile.notices.push_back(
            {"project_settings_taken",
             fmt::format("{}: no profile was named, and the project's own settings hold", part.file)});
      } else if (configured) {
        profile.notices.push_back(
            {"project_settings_left_out",
             fmt::format("{}: a profile was named, and the project's own settings do not hold", part.file)});
      }
      apply_tower(profile, *project, part.file);
      apply_changes(profile, *project, part.file, plate);
    }
  return said;
}

}  // namespace weft
