// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/pipeline.h"

#include <string>
#include <string_view>
#include <vector>

namespace weft::pipeline {

/// The files that settings name and infill is laid by (infill_files): of the whole plate, of what is said of single
/// objects, and of modifiers. Paths as they are opened, each once, in the order they are said.
std::vector<std::string> field_files(const Settings& settings, const ByName& by_name,
                                     const std::vector<ModelMark>& marks);

/// The same of a job.
std::vector<std::string> field_files(const Job& job);

/// Is that the key of a setting that names such a file?
bool names_field_file(std::string_view key);

}  // namespace weft::pipeline
