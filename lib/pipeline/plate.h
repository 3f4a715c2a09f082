// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/stages.h"

namespace weft::pipeline {

/// Reads the models of the job and puts them on the bed.
/// @throws Error{file}, Error{model}; Error{audit} when a model does not fit and the job would reject it anyway
Plate place_models(const Job& job, Report& report, StageCache* cache);

}  // namespace weft::pipeline
