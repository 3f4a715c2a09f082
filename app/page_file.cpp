// SPDX-License-Identifier: GPL-3.0-or-later
#include "page_file.h"

#include "core/file_bytes.h"
#include "core/hash.h"
#include "pipeline/plate.h"
#include "pipeline/profile_file.h"
#include "pipeline/provenance.h"
#include "preview/coverage.h"
#include "preview/model_pack.h"
#include "preview/page.h"
#include "preview/timing.h"
#include "preview_file.h"

#include <algorithm>
#include <filesystem>

namespace weft::app {

std::optional<Settings> settings_in(const std::string& path) {
  try {
    Profile profile;
    apply_profile(profile, path);
    return profile.settings;
  } catch (const Error&) {
    return std::nullopt;  // it says nothing of itself, or what this version does not know
  }
}

Settings settings_for(const Command& command, const std::string& path) {
  if (command.profiles.empty() && command.settings.empty())
    if (auto own = settings_in(path)) return *own;
  return resolve(command).settings;
}

preview::Toolpaths toolpaths_of(std::string_view gcode, const Settings& settings, const std::string& path) {
  auto paths = preview::read(gcode, diameter_of_e(settings));
  if (paths.layers.empty())
    throw Error{Error::Kind::file, "holds no motion that could be drawn", path, "is it G-code?"};
  preview::set_seconds(paths, settings.machine);
  preview::set_support(paths);
  return paths;
}

preview::Overlay overlay_of(const MachineSettings& machine, const audit::Report& report) {
  preview::Overlay overlay{print_surface(machine), machine.bed_exclude_areas, reach_area(machine), {}};
  for (const auto& finding : report.findings) {
    overlay.lines.push_back(static_cast<std::uint32_t>(finding.line));
    overlay.marks.push_back({audit::describe(finding), finding.at, static_cast<std::uint32_t>(finding.line)});
  }
  std::sort(overlay.lines.begin(), overlay.lines.end());
  return overlay;
}

std::string packed_model_of(std::string_view gcode, const std::string& path, const std::vector<std::string>& models) {
  try {
    const auto made_of = provenance_of(gcode, path);
    Job job;
    job.settings = made_of.settings;
    job.placement = made_of.placement;
    job.audit = audit::Mode::annotate;  // what stands beside the bed is drawn there
    for (const auto& wanted : made_of.models) {
      auto candidates = models;
      if (candidates.empty()) candidates = {(std::filesystem::path(path).parent_path() / wanted.name).string()};
      const auto at = std::find_if(candidates.begin(), candidates.end(), [&](const std::string& file) {
        std::error_code error;
        return std::filesystem::is_regular_file(file, error) && sha256(FileBytes(file).view()) == wanted.sha256;
      });
      if (at == candidates.end()) return {};
      job.models.push_back(*at);
    }
    Report report;
    const auto plate = pipeline::place_models(job, report, nullptr);
    std::vector<preview::Standing> standing;
    for (const auto& object : plate.objects)
      for (const auto& volume : object.volumes)
        for (const Point copy : object.copies)
          if (volume.kind == VolumeKind::model) standing.push_back({&volume.mesh, copy});
    return preview::packed_model(standing);
  } catch (const Error&) {
    return {};  // a page without the model is a page
  }
}

std::string page_of(const preview::Toolpaths& paths, std::string_view gcode, const std::string& path,
                    const preview::View& view, const std::optional<preview::Overlay>& overlay,
                    const std::vector<std::string>& models) {
  return preview::page({view.title,
                        view,
                        overlay,
                        {{paths, view.title, overlay ? overlay->marks : std::vector<preview::Mark>{},
                          packed_model_of(gcode, path, models)}}});
}

}  // namespace weft::app
