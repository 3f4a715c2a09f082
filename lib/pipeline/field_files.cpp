// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/field_files.h"

#include "settings/catalogue.h"

#include <algorithm>

namespace weft::pipeline {

bool names_field_file(std::string_view key) {
  const auto* row = find_setting(key);
  return row && std::find(infill_files.begin(), infill_files.end(), row->key) != infill_files.end();
}

std::vector<std::string> field_files(const Settings& settings, const ByName& by_name,
                                     const std::vector<ModelMark>& marks) {
  std::vector<std::string> out;
  const auto take = [&](const std::string& path) {
    if (!path.empty() && std::find(out.begin(), out.end(), path) == out.end()) out.push_back(path);
  };
  const InfillSettings& infill = settings.infill;
  for (const auto* path : {&infill.infill_density_image, &infill.infill_density_field, &infill.infill_direction_field})
    take(*path);
  for (const auto& said : by_name.settings)
    if (names_field_file(said.key)) take(said.text);
  for (const auto& mark : marks)
    for (const auto& [key, text] : mark.settings)
      if (names_field_file(key)) take(text);
  return out;
}

std::vector<std::string> field_files(const Job& job) {
  return field_files(job.settings, job.by_name, job.marks);
}

}  // namespace weft::pipeline
