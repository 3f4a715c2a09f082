// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "gcode/writer.h"
#include "pipeline/stages.h"

#include <vector>

namespace weft::pipeline {

/// Reads the models of the job and puts them on the bed.
/// @throws Error{file}, Error{model}; Error{audit} when a model does not fit and the job would reject it anyway
Plate place_models(const Job& job, Report& report, StageCache* cache);

/// Pictures for the head of the file, in the sizes of the setting `thumbnails`.
std::vector<gcode::Thumbnail> thumbnails_of(const Settings& settings, const Plate& plate);

}  // namespace weft::pipeline
