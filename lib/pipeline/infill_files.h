// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "pipeline/report.h"
#include "settings/groups/infill.h"

#include <vector>

namespace weft::pipeline {

/// The files that infill is laid by, in the settings' order, each with the SHA-256 of what it holds.
/// @throws Error{file} for one that cannot be read
std::vector<Report::InfillFile> infill_files(const InfillSettings& infill);

}  // namespace weft::pipeline
