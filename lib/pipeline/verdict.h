// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "audit/audit.h"
#include "pipeline/pipeline.h"

#include <optional>

namespace weft::pipeline {

/// Asks the audit, and puts what it says into the report.
/// @return what may be written; nothing where the audit rejects it: report.error says why, and what to try
std::optional<audit::Passed> verdict_of(audit::Check& check, const Job& job, Report& report);

}  // namespace weft::pipeline
