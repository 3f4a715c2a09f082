// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/pipeline.h"
#include "pipeline/transform_models.h"

#include <cstddef>
#include <string>
#include <vector>

namespace weft::pipeline {

/// How an object, or an item of the file, is called: as the file has it, else by the file's name.
std::string name_of(const mesh::Loaded& model, std::size_t object);
std::string name_of_item(const mesh::Loaded& model, std::size_t item);

/// How the job's files are read.
mesh::ReadOptions read_options_of(const Job& job);

/// The job's models, welded and repaired, with what the command line or a job lays beside them, and told in the report.
/// @throws Error{file}, Error{model}, Error{usage}
std::vector<Typed> read_models(const Job& job, Report& report, StageCache* cache);

}  // namespace weft::pipeline
