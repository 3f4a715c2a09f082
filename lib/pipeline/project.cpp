// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/project.h"

#include "core/error.h"
#include "mesh/project.h"
#include "pipeline/model_parts.h"
#include "settings/catalogue.h"
#include "settings/tools.h"
#include "settings/value.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>

#include <fmt/format.h>

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
      const bool configured = !project->configuration.empty();
      said = said || (alone && configured) || !project->changes.empty();
      if (alone && configured) {
        ImportOptions inside = options;
        const auto before = profile.origins.size();
        apply_text(profile, project->configuration, part.file, inside);
        if (profile.origins.size() == before)
          throw Error{Error::Kind::settings, "its settings cannot be read: they are damaged, or of another program",
                      part.file, "name a profile"};
        profile.notices.push_back(
            {"project_settings_taken",
             fmt::format("{}: no profile was named, and the project's own settings hold", part.file)});
      } else if (configured || (alone && project->other_configuration)) {
        profile.notices.push_back(
            {"project_settings_left_out",
             configured ? fmt::format("{}: a profile was named, and the project's own settings do not hold", part.file)
                        : fmt::format("{}: the project's own settings are in a form that is not read: name a profile",
                                      part.file)});
      }
      apply_changes(profile, *project, part.file, plate);
    }
  return said;
}

}  // namespace weft
